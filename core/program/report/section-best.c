/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the best cases of a sweep over several axes: for each condition, such as a torque, the
 * table has the best choice, such as a relief. */
#include <flankfilm/engine.h>

#include "page.h"

#include "../memory/memory.h"
#include "../results/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CONDITIONS = 40, MOST_OUTPUTS = 12 };

static bool is_of_first_stage(const results_view *view, const char *path)
{
    const char *first = view->axes[0]->path;
    const size_t length = strcspn(first, ".");
    return !strncmp(path, first, length) && path[length] == '.';
}

report_sides report_sides_of(const results_view *view)
{
    report_sides s = {
        .choice_dims = memory_alloc((view->dimension_count + 1) * sizeof *s.choice_dims),
        .condition_dims = memory_alloc((view->dimension_count + 1) * sizeof *s.condition_dims),
        .choices = 1,
        .conditions = 1};
    for (size_t a = 0; a < view->axis_count; a++)
        if (is_of_first_stage(view, view->axes[a]->path))
            s.choice_dims[view->axes[a]->dimension] = true;
    for (size_t d = 0; d < view->dimension_count; d++) {
        const bool varies = view->lengths[d] > 1;
        s.condition_dims[d] = varies && !s.choice_dims[d];
        s.choice_dims[d] = varies && s.choice_dims[d];
        *(s.choice_dims[d] ? &s.choices : &s.conditions) *= view->lengths[d];
    }
    return s;
}

void report_sides_free(report_sides *s)
{
    free(s->choice_dims);
    free(s->condition_dims);
}

bool report_is_sweep(const results_view *view)
{
    size_t varied = 0;
    for (size_t d = 0; d < view->dimension_count; d++)
        varied += view->lengths[d] > 1;
    if (!view->study || varied < 2 || view->figures_count > 0 || view->axis_count == 0)
        return false;
    report_sides s = report_sides_of(view);
    const bool good = s.choices > 1;
    report_sides_free(&s);
    return good;
}

int report_sense_of(const report_page *page, size_t variable)
{
    for (size_t i = 0; i < page->goal_count; i++)
        if (page->goals[i].variable == variable)
            return page->goals[i].sense;
    const char *asked = report_limit_asked(page->view, variable);
    return !asked ? 0 : *asked == '<' ? -1 : 1;
}

size_t report_find_extreme(const report_scalar *f, const bool *dims, size_t count, size_t first,
                           int sense, bool met, size_t *same)
{
    const results_view *view = f->page->view;
    const double *values = f->values;
    size_t best = SIZE_MAX;
    *same = 0;
    for (size_t j = 0; j < count; j++) {
        const size_t c = first + report_case_of(view, dims, j);
        if (!isfinite(values[c]) || (met && report_standing(view, c) == LIMITS_MISSED))
            continue;
        const double gain = best == SIZE_MAX ? INFINITY : sense * (values[c] - values[best]);
        const bool equal = fabs(gain) <= 1e-9 * fabs(values[c]);
        *same = gain > 0 && !equal ? 0 : *same + equal;
        best = gain > 0 && !equal ? c : best;
    }
    return best;
}

/* Adds "0.1832 um at 4 um, [30 deg, 22 deg]" as a line of a cell. */
static void add_extreme(json_t *cell, const report_scalar *f, const report_sides *s, size_t first,
                        int sense, const char *word, bool met)
{
    const results_view *view = f->page->view;
    const results_view_variable *of = view->variables[f->variable];
    char text[REPORT_TEXT_SIZE], name[REPORT_TEXT_SIZE];
    size_t same;
    const size_t c = report_find_extreme(f, s->choice_dims, s->choices, first, sense, met, &same);
    if (c == SIZE_MAX) {
        json_array_append_new(cell, report_as("div", met ? "no case meets the limits" : "\u2013"));
        return;
    }
    report_quantity_text(of->output, of->unit, f->values[c], text);
    report_name_point(view, c, s->choice_dims, false, name);
    json_t *line =
        json_pack("[s, o, s, o]", word, report_as("b", text), " at ", results_json_text(name));
    if (same > 0)
        json_array_append_new(line, json_pack("[s, {s:s, s:o}]", " ", "as", "small", "of",
                                              json_sprintf("and %zu more", same)));
    json_array_append_new(cell, json_pack("{s:s, s:o}", "as", "div", "of", line));
}

static json_t *best_cell(const report_scalar *f, const report_sides *s, size_t first)
{
    const int sense = report_sense_of(f->page, f->variable);
    json_t *lines = json_array();
    size_t same;
    add_extreme(lines, f, s, first, sense ? sense : -1, sense ? "" : "\u25bc ", sense != 0);
    if (sense == 0 && /* the choice makes a difference */
        report_find_extreme(f, s->choice_dims, s->choices, first, -1, false, &same) != SIZE_MAX &&
        same + 1 < s->choices)
        add_extreme(lines, f, s, first, 1, "\u25b2 ", false);
    return json_pack("{s:o, s:o}", "cell", lines, "title",
                     results_json_text(f->page->view->variables[f->variable]->name));
}

/* Lists the outputs of the table: those named by --best, or all that vary. */
static size_t list_outputs(report_page *page, report_scalar list[MOST_OUTPUTS])
{
    const results_view *view = page->view;
    size_t count = 0;
    for (size_t v = 0; v < view->variable_count && count < MOST_OUTPUTS; v++) {
        bool wanted = page->goal_count == 0 && !report_is_bar(view->variables[v]);
        for (size_t i = 0; i < page->goal_count; i++)
            wanted = wanted || page->goals[i].variable == v;
        if (!wanted || view->variables[v]->rank != 0)
            continue;
        list[count] = report_load_scalar(page, v);
        if (list[count].high > list[count].low)
            count++;
        else
            free(list[count].values);
    }
    return count;
}

/* Returns a head of two lines, with the second in small type. */
static json_t *two_lines(const char *above, char *below)
{
    json_t *head = json_pack("[o, {s:s, s:o}]", results_json_text(above), "as", "div", "of",
                             report_as("small", below));
    free(below);
    return head;
}

/* Returns the head of the first column: the paths of the choices, in the order in which the cells
 * show their values: "0.18 um at 4 um, 30 deg". */
static json_t *chosen_head(const results_view *view, const report_sides *s)
{
    char *list = NULL;
    size_t length = 0;
    FILE *out = memory_require(open_memstream(&list, &length));
    for (size_t a = 0; a < view->axis_count; a++) {
        char words[REPORT_TEXT_SIZE];
        if (s->choice_dims[view->axes[a]->dimension])
            fprintf(out, "%s%s",
                    ftell(out) > 0 ? ", " : "at: ", report_plain_name(view->axes[a]->path, words));
    }
    fclose(out);
    return two_lines("best for", list);
}

static json_t *output_head(const report_page *page, size_t variable)
{
    const results_view_variable *of = page->view->variables[variable];
    const int sense = report_sense_of(page, variable);
    char words[REPORT_TEXT_SIZE];
    return two_lines(of->name, memory_print_text("%s%s", report_output_words(of, words),
                                                 sense < 0   ? "; the least"
                                                 : sense > 0 ? "; the largest"
                                                             : ""));
}

/* Finds the scalar that "OUTPUT=least" names. */
static bool read_sought(const results_view *view, const char *text, report_sought *out,
                        ff_report *report)
{
    const char *sign = strrchr(text, '='), *word = sign ? sign + 1 : "";
    const int length = (int)(sign ? (size_t)(sign - text) : strlen(text));
    const char **names = memory_alloc((view->variable_count + 1) * sizeof *names);
    char *name = memory_print_text("%.*s", length, text);
    size_t count = 0;
    out->sense = !strcmp(word, "least") ? -1 : !strcmp(word, "largest") ? 1 : 0;
    out->variable = SIZE_MAX;
    for (size_t v = 0; v < view->variable_count; v++) {
        if (view->variables[v]->rank != 0)
            continue;
        names[count++] = view->variables[v]->name;
        out->variable = strcmp(view->variables[v]->name, name) ? out->variable : v;
    }
    const char *near = out->variable == SIZE_MAX ? ff_nearest(name, names, count) : NULL;
    if (out->sense == 0)
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                 "--best %.80s: expected OUTPUT=least or OUTPUT=largest", text);
    else if (out->variable == SIZE_MAX)
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                 "--best %.80s: the study has no such scalar%s%s%s", text,
                 near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
    free(name);
    free(names);
    return out->sense != 0 && out->variable != SIZE_MAX;
}

bool report_read_sought(const results_view *view, const char *const *best, size_t count,
                        report_sought *out, ff_report *report)
{
    bool good = true;
    if (count > 0 && !report_is_sweep(view))
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                        "--best %.80s: these results are not of a sweep of several axes", best[0]);
    for (size_t i = 0; i < count; i++)
        good = read_sought(view, best[i], &out[i], report) && good;
    return good;
}

bool report_write_best(report_page *page)
{
    const results_view *view = page->view;
    report_scalar list[MOST_OUTPUTS];
    if (!report_is_sweep(view))
        return false;
    report_sides s = report_sides_of(view);
    const size_t count = list_outputs(page, list);
    const size_t shown = s.conditions < MOST_CONDITIONS ? s.conditions : MOST_CONDITIONS;
    json_t *head = json_array(), *rows = json_array();
    if (s.conditions > 1)
        json_array_append_new(head, chosen_head(view, &s));
    for (size_t i = 0; i < count; i++)
        json_array_append_new(head, output_head(page, list[i].variable));
    for (size_t k = 0; k < shown && count > 0; k++) {
        const size_t first = report_case_of(view, s.condition_dims, k);
        json_t *row = json_array();
        char name[REPORT_TEXT_SIZE];
        report_name_point(view, first, s.condition_dims, true, name);
        if (s.conditions > 1)
            json_array_append_new(row, report_head(name));
        for (size_t i = 0; i < count; i++)
            json_array_append_new(row, best_cell(&list[i], &s, first));
        json_array_append_new(rows, row);
    }
    json_t *table = json_pack("{s:s, s:o, s:o}", "class", "best", "head", head, "rows", rows);
    if (count > 0)
        report_put_table(page->out, table);
    else
        json_decref(table);
    for (size_t i = 0; i < count; i++)
        free(list[i].values);
    if (count > 0)
        fputs("<p class=\"note\">\u25bc the least and \u25b2 the largest value over the choices "
              "for the stage that the sweep names first. For an output with a limit, or named by "
              "--best, only the best of the cases that miss no limit is shown.</p>\n",
              page->out);
    if (shown < s.conditions)
        fprintf(page->out, "<p class=\"note\">The first %zu of %zu conditions.</p>\n", shown,
                s.conditions);
    report_sides_free(&s);
    return count > 0;
}
