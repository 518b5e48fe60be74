/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes the table of the results of several designs, and draws their series. */
#include "compare.h"
#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROOM = 3 * STUDY_NUMBER_SIZE };
static const double noise = 1e-12; /* relative round-off of sums in another order */

/* A number of a design. */
typedef struct number {
    double value, bar; /* SI; value NaN: there is none; bar infinite: the error is not known */
} number;

/* Which number of an output a row shows. */
typedef enum { WHOLE, FIRST, SECOND, LEAST, LARGEST } part;

/* Whether a quality line states the error of an output. "h_min_space_error" concerns the output
 * with the longest name that begins the name of the line, and outputs derived from that one, such
 * as h_min_lowest. */
static bool is_error_of(const results_view *view, const results_view_quality *line,
                        const results_view_variable *of)
{
    static const char ending[] = "_error";
    const size_t length = strlen(line->name), tail = sizeof ending - 1;
    const results_view_variable *stem = NULL;
    if (line->stage != of->stage || length <= tail || strcmp(line->name + length - tail, ending))
        return false;
    for (size_t v = 0; v < view->variable_count; v++) {
        const results_view_variable *other = view->variables[v];
        const size_t own = strlen(other->output);
        if (other->stage == of->stage && !strncmp(line->name, other->output, own) &&
            line->name[own] == '_' && (!stem || own > strlen(stem->output)))
            stem = other;
    }
    const size_t own = stem ? strlen(stem->output) : 0;
    return stem && !strncmp(of->output, stem->output, own) &&
           (!of->output[own] || of->output[own] == '_') && !strcmp(of->unit, stem->unit);
}

/* Returns the error of number k of a variable: as measured, or the largest relative error stated by
 * a line of its stage. A line without a number means that the error is not known. */
static double bar_of(report_page *page, size_t variable, size_t index, size_t k, double value)
{
    const results_view *view = page->view;
    const results_view_variable *of = view->variables[variable];
    ff_array bars = report_load(page, report_find_bar(view, variable), index);
    double bar = bars.data && k < report_array_size(&bars) ? bars.data[k] : (double)NAN;
    report_release(page, &bars);
    const bool measured = !isnan(bar);
    for (size_t i = 0; !measured && i < view->cases[index]->quality_count; i++) {
        const results_view_quality *line = view->cases[index]->quality[i];
        if (is_error_of(view, line, of))
            bar = fmax(bar, isfinite(line->value) ? fabs(line->value * value) : (double)INFINITY);
    }
    return bar;
}

/* Finds a variable by its name; -1 if there is none. */
static int find(const results_view *view, const char *name)
{
    for (size_t v = 0; v < view->variable_count; v++)
        if (!strcmp(view->variables[v]->name, name))
            return (int)v;
    return -1;
}

static size_t rank_of(const results_view_variable *of, const ff_array *array, part what)
{
    if (what < LEAST)
        return what == SECOND;
    const report_extremes at = report_find_extremes(array);
    return *of->whole ? of->extremes[what == LARGEST] : what == LEAST ? at.least : at.greatest;
}

/* Reads a number of a design. Returns false after an error. */
static bool read_number(const report_design *design, const char *name, part what, number *out)
{
    report_page page = {.view = design->view};
    const int variable = find(design->view, name);
    *out = (number){NAN, NAN};
    ff_array array = report_load(&page, variable, design->index);
    const size_t at = array.data ? rank_of(design->view->variables[variable], &array, what) : 0;
    if (array.data && at < report_array_size(&array)) {
        out->value = array.data[at];
        out->bar = bar_of(&page, (size_t)variable, design->index, at, out->value);
    }
    report_release(&page, &array);
    return !page.failed;
}

/* Prints a number, with its error, in the unit of the row: "0.2481 +- 0.003". */
static void print_number(number n, const study_readable *unit, bool signs, char out[ROOM])
{
    char value[STUDY_NUMBER_SIZE], bar[STUDY_NUMBER_SIZE];
    study_number_text(n.value * unit->factor + (signs ? 0 : unit->offset), 4, " ", value);
    study_number_text(n.bar * unit->factor, 2, " ", bar);
    snprintf(out, ROOM, "%s%s%s%s", signs && n.value > 0 ? "+" : "", isnan(n.value) ? "-" : value,
             n.bar > 0 ? " +- " : "", n.bar > 0 ? bar : "");
}

/* Prints the difference of a design from the first one. Its bar is the sum of both bars, since
 * errors of the same kind need not cancel. */
static void print_difference(number first, number other, const study_readable *unit,
                             char out[2 * ROOM])
{
    const number d = {other.value - first.value, first.bar + other.bar};
    char text[ROOM];
    out[0] = '\0';
    if (isnan(d.value))
        return;
    print_number(d, unit, true, text);
    const double share = d.value / fabs(first.value);
    const bool plain = unit->offset == 0 && first.value != 0 && isfinite(share);
    char percent[STUDY_NUMBER_SIZE];
    study_number_text(100 * share, 3, " ", percent);
    if (fabs(d.value) <= noise * fabs(first.value))
        snprintf(out, 2 * ROOM, "the same");
    else if (fabs(d.value) <= d.bar)
        snprintf(out, 2 * ROOM, "%s: less than the errors", text);
    else if (plain)
        snprintf(out, 2 * ROOM, "%s (%s%s %%)", text, share > 0 ? "+" : "", percent);
    else
        snprintf(out, 2 * ROOM, "%s", text);
}

/* Sets member "NAME<rank>". */
static void set(json_t *row, const char *name, size_t rank, json_t *value)
{
    char key[32];
    snprintf(key, sizeof key, "%s%zu", name, rank);
    json_object_set_new(row, key, value);
}

/* Adds the row for one number of an output. Returns false after an error. */
static bool add_row(json_t *rows, const results_view_variable *of, part what,
                    const report_design *designs, size_t count)
{
    static const char *const words[] = {"", " (1)", " (2)", ", least", ", largest"};
    number *numbers = memory_alloc(count * sizeof *numbers);
    double most = 0;
    bool good = true;
    for (size_t i = 0; good && i < count; i++) {
        good = read_number(&designs[i], of->name, what, &numbers[i]);
        most = fmax(most, fabs(numbers[i].value));
    }
    const study_readable unit = study_readable_output(of->output, of->unit, most);
    json_t *row = json_pack("{s:s+, s:s, s:s}", "output", of->name, words[what], "unit", unit.unit,
                            "si", of->unit);
    for (size_t i = 0; good && i < count; i++) {
        char text[ROOM], difference[2 * ROOM];
        print_number(numbers[i], &unit, false, text);
        set(row, "text", i, json_string(text));
        set(row, "value", i, study_json_real(numbers[i].value));
        set(row, "bar", i, study_json_real(numbers[i].bar));
        print_difference(numbers[0], numbers[i], &unit, difference);
        set(row, "difference", i, json_string(i ? difference : ""));
    }
    json_array_append_new(rows, row);
    free(numbers);
    return good;
}

/* Whether an earlier design also has the output. */
static bool is_known(const report_design *designs, size_t before, const char *name)
{
    for (size_t i = 0; i < before; i++) {
        const int known = find(designs[i].view, name);
        if (known >= 0 && designs[i].view->variables[known]->flags & RESULTS_VIEW_ASKED)
            return true;
    }
    return false;
}

/* Adds the rows for an output: one for a scalar, two for a series or for the values of two gears,
 * none for a field or for a series that is only the axis of others. */
static bool add_output(json_t *rows, size_t v, size_t owner, const report_design *designs,
                       size_t count)
{
    const results_view *view = designs[owner].view;
    const results_view_variable *of = view->variables[v];
    size_t shape[4];
    if (!(of->flags & RESULTS_VIEW_ASKED) || report_is_bar(of) || of->rank > 1 ||
        is_known(designs, owner, of->name) || report_is_axis(view, v))
        return true;
    if (of->rank == 0)
        return add_row(rows, of, WHOLE, designs, count);
    const bool pair =
        results_view_full_shape(view, v, designs[owner].index, shape) && shape[0] == 2;
    return add_row(rows, of, pair ? FIRST : LEAST, designs, count) &&
           add_row(rows, of, pair ? SECOND : LARGEST, designs, count);
}

/* Prints for each design whether it meets the limits of its file, and what is doubtful. */
static void print_verdicts(study_answer *answer, const report_design *designs, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const results_view_case *c = designs[i].view->cases[designs[i].index];
        study_answer_say(answer, STUDY_ON_TERMINAL | STUDY_ON_PAGE, 4, "%s: %s%s%s%s%s%s%s%s",
                         designs[i].name, strcmp(c->status, "ok") ? c->status : c->verdict,
                         *c->reasons ? ", " : "", c->reasons,
                         *c->range ? "; outside the range of a model: " : "", c->range,
                         *c->limits_text ? "; limits " : "", c->limits_text,
                         i == 0 ? "; the others are compared with it" : "");
    }
}

/* Draws a series that every design has along its path of contact. Returns false after an error. */
static bool draw(study_answer *answer, const results_view_variable *of,
                 const report_design *designs, size_t count)
{
    report_data d = {.outputs = json_object()};
    json_t *series = json_array(), *cases = json_array();
    bool good = true;
    for (size_t i = 0; i < count && good; i++) {
        report_page page = {.view = designs[i].view};
        const int v = find(page.view, of->name),
                  axis = v < 0 ? -1 : report_find_axis(page.view, (size_t)v, 0, designs[i].index);
        d.page = &page;
        json_array_append_new(cases, report_data_case(&page, designs[i].index, designs[i].name));
        if (axis >= 0 && !strcmp(page.view->variables[axis]->unit, "rad"))
            report_data_series(&d, series, (size_t)v, designs[i].index, i);
        good = !page.failed;
    }
    if (good && json_array_size(series) == count) {
        char words[REPORT_TEXT_SIZE];
        study_answer_draw(answer,
                          json_pack("{s:s, s:s++, s:O, s:O, s:O}", "sort", "path", "title",
                                    of->name, ": ", report_output_words(of, words), "outputs",
                                    d.outputs, "series", series, "cases", cases));
    }
    json_decref(d.outputs);
    json_decref(series);
    json_decref(cases);
    return good;
}

bool report_compare(study_answer *answer, const report_design *designs, size_t count)
{
    json_t *rows = json_array();
    bool good = true;
    for (size_t i = 0; i < count; i++)
        for (size_t v = 0; good && v < designs[i].view->variable_count; v++)
            good = add_output(rows, v, i, designs, count);
    study_context *context = answer->context;
    study_column *columns = memory_arena_alloc(&context->arena, (4 + 4 * count) * sizeof *columns);
    size_t n = 0;
    columns[n++] = (study_column){
        .of = {"output"}, .name = "output of flankfilm", .head = "output", .width = -6};
    for (size_t i = 0; i < count; i++)
        columns[n++] = (study_column){.of = {study_context_format(context, "text%zu", i)},
                                      .head = designs[i].name,
                                      .before = "  ",
                                      .width = -8};
    columns[n++] = (study_column){.of = {"unit"}, .head = "", .width = -1};
    for (size_t i = 1; i < count; i++)
        columns[n++] = (study_column){
            .of = {study_context_format(context, "difference%zu", i)},
            .head =
                count > 2 ? study_context_format(context, "by %s", designs[i].name) : "difference",
            .before = "  ",
            .width = -8};
    columns[n++] = (study_column){.of = {"si"}, .name = "unit"};
    for (size_t i = 0; i < 2 * count; i++)
        columns[n++] = (study_column){
            .of = {study_context_format(context, i % 2 ? "bar%zu" : "value%zu", i / 2)},
            .name =
                study_context_format(context, i % 2 ? "error of %s" : "%s", designs[i / 2].name)};
    if (good)
        print_verdicts(answer, designs, count);
    study_answer_add(
        answer,
        &(study_table){.summary = "What each gives",
                       .columns = columns,
                       .column_count = n,
                       .rows = rows,
                       .forms = good ? STUDY_IN_FILE | STUDY_ON_TERMINAL | STUDY_ON_PAGE : 0,
                       .digits = 9,
                       .whole = true});
    for (size_t v = 0; good && v < designs[0].view->variable_count; v++) {
        const results_view_variable *of = designs[0].view->variables[v];
        if (of->rank == 1 && of->flags & RESULTS_VIEW_ASKED && !report_is_axis(designs[0].view, v))
            good = draw(answer, of, designs, count);
    }
    return good;
}
