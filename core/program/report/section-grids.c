/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a scalar over all cases of a sweep as small tables, if there are too many values for a
 * figure. */
#include "page.h"

#include "../memory/memory.h"
#include "../results/json.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_COLUMNS = 16, MOST_ROWS = 40, MOST_PANELS = 60 };

/* Returns the longest of the remaining dimensions; -1 if none is left. */
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

/* The contents of a small table. */
typedef struct panel {
    const report_scalar *scalar;
    size_t first;
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

static json_t *square(const report_page *page, const panel *p, size_t c)
{
    const double value = p->scalar->values[c];
    const int32_t standing = report_standing(page->view, c);
    char text[REPORT_TEXT_SIZE], class[20], number[REPORT_TEXT_SIZE];
    report_number_text(report_convert(&p->scalar->unit, value), number);
    const double share = p->high > p->low ? (value - p->low) / (p->high - p->low) : 0;
    snprintf(class, sizeof class, "%s%s",
             standing == LIMITS_MISSED   ? "missed"
             : standing == LIMITS_WITHIN ? "within"
                                         : "",
             c == p->best || c == p->least || c == p->largest ? " mark" : "");
    snprintf(text, sizeof text, "%s%.100s",
             c == p->best      ? "\u2605\u202f"
             : c == p->least   ? "\u25bc\u202f"
             : c == p->largest ? "\u25b2\u202f"
                               : "",
             number);
    json_t *cell = report_cell(class, text);
    if (isfinite(value))
        json_object_set_new(cell, "share", json_real(10 + 50 * share));
    return cell;
}

static void mark(const report_page *page, panel *p, const bool *dims, size_t count)
{
    const double *values = p->scalar->values;
    const int sense = report_sense_of(page, p->scalar->variable);
    size_t same;
    p->least = report_find_extreme(p->scalar, dims, count, p->first, -1, false, &same);
    p->largest = report_find_extreme(p->scalar, dims, count, p->first, 1, false, &same);
    p->low = p->least == SIZE_MAX ? 0 : values[p->least];
    p->high = p->largest == SIZE_MAX ? 0 : values[p->largest];
    p->best = SIZE_MAX;
    const bool level = !(p->high > p->low);
    if (!level && sense != 0)
        p->best = report_find_extreme(p->scalar, dims, count, p->first, sense, true, &same);
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
    json_t *head = json_pack("[s]", ""), *table = json_array();
    for (size_t i = 0; i < columns; i++)
        json_array_append_new(head, results_json_text(word_at(view, p->across, i, word)));
    for (size_t k = 0; k < rows; k++) {
        json_t *row =
            json_pack("[o]", report_head(p->down < 0 ? "" : word_at(view, p->down, k, word)));
        for (size_t i = 0; i < columns; i++)
            json_array_append_new(row, square(page, p,
                                              p->first + report_case_of(view, across, i) +
                                                  report_case_of(view, down, k)));
        json_array_append_new(table, row);
    }
    report_put_table(page->out, json_pack("{s:s, s:o, s:o, s:o}", "class", "fixed grid", "caption",
                                          results_json_text(name), "head", head, "rows", table));
    free(across);
    free(down);
}

bool report_write_grids(const report_scalar *scalar)
{
    report_page *page = scalar->page;
    const results_view *view = page->view;
    report_sides s = report_sides_of(view);
    panel p = {.scalar = scalar, .across = take_longest(view, s.choice_dims)};
    p.down = take_longest(view, s.choice_dims);
    for (size_t d = 0; d < view->dimension_count; d++) /* each point of the remaining dimensions has
                                                        * a table */
        s.condition_dims[d] = s.condition_dims[d] || s.choice_dims[d];
    if (p.down < 0)
        p.down = take_longest(view, s.condition_dims);
    size_t panels = 1, squares = p.across < 0 ? 0 : view->lengths[p.across];
    const size_t rows = p.down < 0 ? 1 : view->lengths[p.down];
    const bool good = squares > 0 && squares <= MOST_COLUMNS && rows <= MOST_ROWS;
    for (size_t d = 0; d < view->dimension_count; d++)
        panels *= s.condition_dims[d] ? view->lengths[d] : 1;
    bool *shown = memory_alloc((view->dimension_count + 1) * sizeof *shown);
    if (good) {
        shown[p.across] = true;
        if (p.down >= 0)
            shown[p.down] = true;
        report_print(page->out,
                     "<div class=\"broad\"><h3>%s: %s</h3>\n<p class=\"note\">columns: %s%s%s; in "
                     "each table, shading increases from the least to the largest value</p>\n<div "
                     "class=\"grids\">\n",
                     view->variables[scalar->variable]->name, scalar->label,
                     path_of(view, p.across),
                     p.down < 0 ? "" : "; down: ", p.down < 0 ? "" : path_of(view, p.down));
    }
    for (size_t k = 0; good && k < panels && k < MOST_PANELS; k++) {
        char name[REPORT_TEXT_SIZE];
        p.first = report_case_of(view, s.condition_dims, k);
        report_name_point(view, p.first, s.condition_dims, true, name);
        mark(page, &p, shown, squares * rows);
        write_panel(page, &p, name);
    }
    fputs(good ? "</div></div>\n" : "", page->out);
    if (good && panels > MOST_PANELS)
        fprintf(page->out, "<p class=\"note\">The first %d of %zu combinations.</p>\n", MOST_PANELS,
                panels);
    free(shown);
    report_sides_free(&s);
    return good;
}
