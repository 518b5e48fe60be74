/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The best of a sweep of several axes. Paths of the stage that the sweep names first are what is
 * chosen, such as a relief; the others are the conditions that are met, such as torques. For each
 * condition a table names the values that are best, and small tables show all of them.
 */
#include <flankfilm/engine.h>

#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CONDITIONS = 40, MOST_OUTPUTS = 12, MOST_COLUMNS = 16, MOST_ROWS = 40 };
enum { MOST_PANELS = 60 };

/* Which of the study's dimensions are chosen, and which are met; each has more than one point. */
typedef struct sides {
    bool *chosen, *met;
    size_t choices, conditions; /* numbers of their combinations */
} sides;

static bool is_of_first_stage(const results_view *view, const char *path)
{
    const char *first = view->axes[0]->path;
    const size_t length = strcspn(first, ".");
    return !strncmp(path, first, length) && path[length] == '.';
}

static sides sides_of(const results_view *view)
{
    sides s = {.chosen = memory_alloc((view->dimension_count + 1) * sizeof *s.chosen),
               .met = memory_alloc((view->dimension_count + 1) * sizeof *s.met),
               .choices = 1,
               .conditions = 1};
    for (size_t a = 0; a < view->axis_count; a++)
        if (is_of_first_stage(view, view->axes[a]->path))
            s.chosen[view->axes[a]->dimension] = true;
    for (size_t d = 0; d < view->dimension_count; d++) {
        const bool varies = view->lengths[d] > 1;
        s.met[d] = varies && !s.chosen[d];
        s.chosen[d] = varies && s.chosen[d];
        *(s.chosen[d] ? &s.choices : &s.conditions) *= view->lengths[d];
    }
    return s;
}

static void free_sides(sides *s)
{
    free(s->chosen);
    free(s->met);
}

bool report_is_sweep(const results_view *view)
{
    size_t varied = 0;
    for (size_t d = 0; d < view->dimension_count; d++)
        varied += view->lengths[d] > 1;
    if (!view->study || varied < 2 || view->figures_count > 0 || view->axis_count == 0)
        return false;
    sides s = sides_of(view);
    const bool good = s.choices > 1;
    free_sides(&s);
    return good;
}

/* The limit of an output in a case; NULL: there is none. */
static const results_view_limit *limit_of(const results_view *view, size_t variable, size_t index)
{
    const results_view_case *c = view->cases[index];
    for (size_t i = 0; i < c->limit_count; i++)
        if (!strcmp(c->limits[i]->output, view->variables[variable]->name))
            return c->limits[i];
    return NULL;
}

/* The first limit of an output that any case has. */
static const results_view_limit *any_limit(const results_view *view, size_t variable)
{
    const results_view_limit *limit = NULL;
    for (size_t c = 0; c < view->case_count && !limit; c++)
        limit = limit_of(view, variable, c);
    return limit;
}

const char *report_limit_asked(const results_view *view, size_t variable)
{
    const results_view_limit *limit = any_limit(view, variable);
    return limit ? limit->asked : NULL;
}

double report_limit_bound(const results_view *view, size_t variable)
{
    const results_view_limit *limit = any_limit(view, variable);
    ff_unit unit;
    double bound = NAN;
    char why[160];
    if (!limit || !ff_unit_parse(limit->unit, &unit, why, sizeof why) ||
        !ff_quantity_parse(limit->asked + strspn(limit->asked, "<>= "), &unit, limit->unit, &bound,
                           why, sizeof why))
        return NAN;
    return bound;
}

/* Which number of an output is best: -1 the least, 1 the largest, 0 where nothing says it. The
   reader's own choice goes before a limit of the file. */
static int sense_of(const report_page *page, size_t variable)
{
    for (size_t i = 0; i < page->goal_count; i++)
        if (page->goals[i].variable == variable)
            return page->goals[i].sense;
    const results_view_limit *limit = any_limit(page->view, variable);
    return !limit ? 0 : *limit->asked == '<' ? -1 : 1;
}

int32_t report_standing(const results_view *view, size_t index)
{
    const results_view_case *c = view->cases[index];
    int32_t worst = LIMITS_MET;
    for (size_t i = 0; i < c->limit_count; i++)
        worst = c->limits[i]->standing > worst ? c->limits[i]->standing : worst;
    return worst;
}

/* Finds the case with the least (-1) or largest (1) value among the combinations of some
   dimensions, from the case `first`; SIZE_MAX: no value is known. Of values that are best, those of
   cases that miss a limit do not count. `same` counts others with the same value. */
static size_t find_extreme(const results_view *view, const double *values, const bool *dims,
                           size_t count, size_t first, int sense, bool met, size_t *same)
{
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

ptrdiff_t report_best_of(const report_page *page, size_t variable, const double *values,
                         size_t first, size_t x, size_t y)
{
    const results_view *view = page->view;
    const int sense = sense_of(page, variable);
    bool *dims = memory_alloc(view->dimension_count * sizeof *dims);
    size_t same;
    dims[x] = dims[y] = true;
    const size_t c = sense == 0
                         ? SIZE_MAX
                         : find_extreme(view, values, dims, view->lengths[x] * view->lengths[y],
                                        first, sense, true, &same);
    free(dims);
    return c == SIZE_MAX ? -1
                         : (ptrdiff_t)(results_view_point(view, c, y) * view->lengths[x] +
                                       results_view_point(view, c, x));
}

/* Writes "0.1832 um: 4 um, [30 deg, 22 deg]". */
static void put_extreme(report_page *page, size_t variable, const double *values, const sides *s,
                        size_t first, int sense, const char *word, bool met)
{
    const results_view *view = page->view;
    const results_view_variable *of = view->variables[variable];
    char text[REPORT_TEXT_SIZE], name[REPORT_TEXT_SIZE];
    size_t same;
    const size_t c = find_extreme(view, values, s->chosen, s->choices, first, sense, met, &same);
    if (c == SIZE_MAX) {
        report_print(page->out, "<div>%s</div>", met ? "none meets the limits" : "\u2013");
        return;
    }
    report_quantity_text(of->output, of->unit, values[c], text);
    report_name_point(view, c, s->chosen, name);
    report_print(page->out, "<div>%s<b>%s</b> at %s", word, text, name);
    if (same > 0)
        fprintf(page->out, " <small>and %zu more</small>", same);
    fputs("</div>", page->out);
}

/* Whether the choice makes a difference. */
static bool varies(const double *values, const results_view *view, const sides *s, size_t first)
{
    size_t same;
    const size_t least = find_extreme(view, values, s->chosen, s->choices, first, -1, false, &same);
    return least != SIZE_MAX && same + 1 < s->choices;
}

static void put_cell(report_page *page, size_t variable, const double *values, const sides *s,
                     size_t first)
{
    const int sense = sense_of(page, variable);
    report_print(page->out, "<td data-head=\"%s\">", page->view->variables[variable]->name);
    if (sense != 0) {
        put_extreme(page, variable, values, s, first, sense, "", true);
    } else {
        put_extreme(page, variable, values, s, first, -1, "\u25bc ", false);
        if (varies(values, page->view, s, first))
            put_extreme(page, variable, values, s, first, 1, "\u25b2 ", false);
    }
    fputs("</td>", page->out);
}

/* Lists the outputs that the table has: those of the reader's choice, or all that vary. */
static size_t list_outputs(report_page *page, size_t list[MOST_OUTPUTS],
                           double *values[MOST_OUTPUTS])
{
    const results_view *view = page->view;
    size_t count = 0;
    for (size_t v = 0; v < view->variable_count && count < MOST_OUTPUTS; v++) {
        bool wanted = page->goal_count == 0 && !report_is_bar(view->variables[v]);
        for (size_t i = 0; i < page->goal_count; i++)
            wanted = wanted || page->goals[i].variable == v;
        if (!wanted || view->variables[v]->rank != 0)
            continue;
        values[count] = report_load_values(page, v);
        double low = INFINITY, high = -INFINITY;
        for (size_t c = 0; c < view->case_count; c++) {
            low = fmin(low, values[count][c]);
            high = fmax(high, values[count][c]);
        }
        if (high > low)
            list[count++] = v;
        else
            free(values[count]);
    }
    return count;
}

static void put_head(report_page *page, size_t variable)
{
    const results_view_variable *of = page->view->variables[variable];
    const int sense = sense_of(page, variable);
    char words[REPORT_TEXT_SIZE];
    report_print(page->out, "<th>%s<br><small>%s%s</small></th>", of->name,
                 report_output_words(of, words),
                 sense < 0   ? "; the least"
                 : sense > 0 ? "; the largest"
                             : "");
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
    size_t list[MOST_OUTPUTS];
    double *values[MOST_OUTPUTS];
    if (!report_is_sweep(view))
        return false;
    sides s = sides_of(view);
    const size_t count = list_outputs(page, list, values);
    const size_t rows = s.conditions < MOST_CONDITIONS ? s.conditions : MOST_CONDITIONS;
    if (count > 0) {
        fputs("<div class=\"wide\"><table class=\"best\"><thead><tr>", page->out);
        fputs(s.conditions > 1 ? "<th>best for</th>" : "", page->out);
        for (size_t i = 0; i < count; i++)
            put_head(page, list[i]);
        fputs("</tr></thead><tbody>\n", page->out);
    }
    for (size_t k = 0; k < rows && count > 0; k++) {
        const size_t first = report_case_of(view, s.met, k);
        char name[REPORT_TEXT_SIZE];
        report_name_point(view, first, s.met, name);
        fputs("<tr>", page->out);
        if (s.conditions > 1)
            report_print(page->out, "<th scope=\"row\">%s</th>", name);
        for (size_t i = 0; i < count; i++)
            put_cell(page, list[i], values[i], &s, first);
        fputs("</tr>\n", page->out);
    }
    for (size_t i = 0; i < count; i++)
        free(values[i]);
    if (count > 0)
        fputs("</tbody></table></div>\n<p class=\"note\">\u25bc the least, \u25b2 the largest of "
              "the values of the stage that the sweep names first; an output with a limit, or "
              "named by --best, has the best one alone, of cases that miss no limit.</p>\n",
              page->out);
    if (rows < s.conditions)
        fprintf(page->out, "<p class=\"note\">The first %zu of %zu conditions.</p>\n", rows,
                s.conditions);
    free_sides(&s);
    return count > 0;
}

/* The longest dimension of those that are left; -1: none is. */
static int take_longest(const results_view *view, bool *left)
{
    int best = -1;
    for (size_t d = 0; d < view->dimension_count; d++)
        if (left[d] && (best < 0 || view->lengths[d] > view->lengths[best]))
            best = (int)d;
    if (best >= 0)
        left[best] = false;
    return best;
}

/* What a small table shows. */
typedef struct panel {
    const report_scalar *scalar;
    size_t variable, first;
    int across, down;            /* dimensions; down may be -1 */
    size_t least, largest, best; /* cases; SIZE_MAX: not marked */
    double low, high;
} panel;

static const char *word_at(const results_view *view, int dimension, size_t point,
                           char out[REPORT_TEXT_SIZE])
{
    for (size_t a = 0; a < view->axis_count; a++)
        if ((int)view->axes[a]->dimension == dimension)
            return report_axis_word(view->axes[a], point, out);
    return "";
}

static const char *path_of(const results_view *view, int dimension)
{
    for (size_t a = 0; a < view->axis_count; a++)
        if ((int)view->axes[a]->dimension == dimension)
            return view->axes[a]->path;
    return "";
}

static void put_square(report_page *page, const panel *p, size_t c)
{
    const results_view *view = page->view;
    const double value = p->scalar->values[c];
    const int32_t standing = report_standing(view, c);
    char text[REPORT_TEXT_SIZE];
    report_number_text(report_convert(&p->scalar->unit, value), text);
    const double share = p->high > p->low ? (value - p->low) / (p->high - p->low) : 0;
    fprintf(page->out, "<td class=\"%s%s\"",
            standing == LIMITS_MISSED   ? "missed"
            : standing == LIMITS_WITHIN ? "within"
                                        : "",
            c == p->best || c == p->least || c == p->largest ? " mark" : "");
    if (isfinite(value))
        fprintf(page->out, " style=\"--s:%.0f%%\"", 10 + 50 * share);
    report_print(page->out, ">%s%s</td>",
                 c == p->best      ? "\u2605\u202f"
                 : c == p->least   ? "\u25bc\u202f"
                 : c == p->largest ? "\u25b2\u202f"
                                   : "",
                 text);
}

static void mark(const report_page *page, panel *p, const bool *dims, size_t count)
{
    const double *values = p->scalar->values;
    const int sense = sense_of(page, p->variable);
    size_t same;
    p->least = find_extreme(page->view, values, dims, count, p->first, -1, false, &same);
    p->largest = find_extreme(page->view, values, dims, count, p->first, 1, false, &same);
    p->low = p->least == SIZE_MAX ? 0 : values[p->least];
    p->high = p->largest == SIZE_MAX ? 0 : values[p->largest];
    p->best = SIZE_MAX;
    const bool level = !(p->high > p->low);
    if (!level && sense != 0)
        p->best = find_extreme(page->view, values, dims, count, p->first, sense, true, &same);
    if (level || sense != 0)
        p->least = p->largest = SIZE_MAX;
}

static void write_panel(report_page *page, const panel *p, const char *name)
{
    const results_view *view = page->view;
    const size_t columns = view->lengths[p->across],
                 rows = p->down < 0 ? 1 : view->lengths[p->down];
    bool *across = memory_alloc((view->dimension_count + 1) * sizeof *across),
         *down = memory_alloc((view->dimension_count + 1) * sizeof *down);
    char word[REPORT_TEXT_SIZE];
    across[p->across] = true;
    if (p->down >= 0)
        down[p->down] = true;
    report_print(page->out,
                 "<div class=\"wide\"><table class=\"fixed grid\"><caption>%s</caption>"
                 "<tbody><tr><th></th>",
                 name);
    for (size_t i = 0; i < columns; i++)
        report_print(page->out, "<th>%s</th>", word_at(view, p->across, i, word));
    for (size_t k = 0; k < rows; k++) {
        report_print(page->out, "</tr>\n<tr><th scope=\"row\">%s</th>",
                     p->down < 0 ? "" : word_at(view, p->down, k, word));
        for (size_t i = 0; i < columns; i++)
            put_square(page, p,
                       p->first + report_case_of(view, across, i) + report_case_of(view, down, k));
    }
    fputs("</tr></tbody></table></div>\n", page->out);
    free(across);
    free(down);
}

bool report_write_grids(report_page *page, size_t variable, const report_scalar *scalar)
{
    const results_view *view = page->view;
    sides s = sides_of(view);
    panel p = {.scalar = scalar, .variable = variable, .across = take_longest(view, s.chosen)};
    p.down = take_longest(view, s.chosen);
    for (size_t d = 0; d < view->dimension_count; d++) /* what is left has a table for each point */
        s.met[d] = s.met[d] || s.chosen[d];
    if (p.down < 0)
        p.down = take_longest(view, s.met);
    size_t panels = 1, squares = p.across < 0 ? 0 : view->lengths[p.across];
    const size_t rows = p.down < 0 ? 1 : view->lengths[p.down];
    const bool good = squares > 0 && squares <= MOST_COLUMNS && rows <= MOST_ROWS;
    for (size_t d = 0; d < view->dimension_count; d++)
        panels *= s.met[d] ? view->lengths[d] : 1;
    bool *shown = memory_alloc((view->dimension_count + 1) * sizeof *shown);
    if (good) {
        shown[p.across] = true;
        if (p.down >= 0)
            shown[p.down] = true;
        report_print(page->out,
                     "<div class=\"broad\"><h3>%s: %s</h3>\n<p class=\"note\">across: %s",
                     view->variables[variable]->name, scalar->label, path_of(view, p.across));
        report_print(page->out, "%s%s; shaded from the least to the largest of each table</p>\n",
                     p.down < 0 ? "" : "; down: ", p.down < 0 ? "" : path_of(view, p.down));
        fputs("<div class=\"grids\">\n", page->out);
        page->figures++;
    }
    for (size_t k = 0; good && k < panels && k < MOST_PANELS; k++) {
        char name[REPORT_TEXT_SIZE];
        p.first = report_case_of(view, s.met, k);
        report_name_point(view, p.first, s.met, name);
        mark(page, &p, shown, squares * rows);
        write_panel(page, &p, name);
    }
    fputs(good ? "</div></div>\n" : "", page->out);
    if (good && panels > MOST_PANELS)
        fprintf(page->out, "<p class=\"note\">The first %d of %zu combinations.</p>\n", MOST_PANELS,
                panels);
    free(shown);
    free_sides(&s);
    return good;
}
