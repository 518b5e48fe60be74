/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Describes figures as JSON, for script.js to draw. Of a curve with more points than a drawing has
 * columns, each column keeps its first, lowest, highest and last one, so that no peak is lost.
 */
#include "page.h"

#include "../memory/memory.h"
#include "../results/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 700, MOST_DOTS = 3000, MOST_CELLS = 200 };

report_curve *report_plot_add(report_plot *plot, const study_readable *x_unit, const double *x,
                              const study_readable *y_unit, const double *y, size_t count)
{
    if (plot->count == REPORT_MOST_CURVES || count == 0)
        return NULL;
    report_curve *curve = &plot->curves[plot->count];
    *curve = (report_curve){.x = memory_alloc(count * sizeof *curve->x),
                            .y = memory_alloc(count * sizeof *curve->y),
                            .count = count,
                            .colour = (int)plot->count};
    for (size_t i = 0; i < count; i++) {
        curve->x[i] = x ? report_convert(x_unit, x[i]) : (double)i;
        curve->y[i] = report_convert(y_unit, y[i]);
    }
    plot->count++;
    return curve;
}

report_curve *report_plot_find(report_plot *plot, const study_readable *unit, const double *y,
                               size_t count, double share)
{
    for (size_t k = 0; k < plot->count; k++) {
        report_curve *curve = &plot->curves[k];
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < curve->count; i++) {
            low = fmin(low, curve->y[i]);
            high = fmax(high, curve->y[i]);
        }
        bool same = curve->count == count;
        for (size_t i = 0; i < count && same; i++)
            same = fabs(curve->y[i] - report_convert(unit, y[i])) <= share * (high - low);
        if (same)
            return curve;
    }
    return NULL;
}

void report_curve_bar(report_curve *curve, const study_readable *y_unit, const double *bar)
{
    curve->bar = memory_alloc(curve->count * sizeof *curve->bar);
    for (size_t i = 0; i < curve->count; i++)
        curve->bar[i] = fabs(y_unit->factor) * bar[i];
}

void report_plot_free(report_plot *plot)
{
    for (size_t i = 0; i < plot->count; i++) {
        free(plot->curves[i].bar);
        free(plot->curves[i].x);
        free(plot->curves[i].y);
    }
    plot->count = 0;
}

/* A number with the six digits that a drawing needs; null where none is known. */
static json_t *number(double value)
{
    char text[32];
    if (!isfinite(value))
        return json_null();
    snprintf(text, sizeof text, "%.6g", value);
    return json_real(strtod(text, NULL));
}

static bool is_rising(const report_curve *curve)
{
    for (size_t i = 1; i < curve->count; i++)
        if (!(curve->x[i] >= curve->x[i - 1]))
            return false;
    return true;
}

/* Keeps the first, lowest, highest and last of the points from..to, in their order. */
static size_t keep_column(const report_curve *curve, size_t from, size_t to, size_t *kept)
{
    size_t low = from, high = from, count = 0;
    for (size_t i = from; i < to; i++) {
        low = curve->y[i] < curve->y[low] ? i : low;
        high = curve->y[i] > curve->y[high] ? i : high;
    }
    const size_t chosen[4] = {from, low < high ? low : high, low < high ? high : low, to - 1};
    for (size_t i = 0; i < 4; i++)
        if (i == 0 || chosen[i] != chosen[i - 1])
            kept[count++] = chosen[i];
    return count;
}

/* Fills in the ranks of the points that are drawn, and returns how many they are. */
static size_t choose_points(const report_curve *curve, size_t *kept, bool *thinned)
{
    size_t count = 0;
    bool columns = !curve->dots && curve->count > 4 * COLUMNS && is_rising(curve);
    size_t step = curve->dots ? curve->count / MOST_DOTS + 1 : 1;
    double width = (curve->x[curve->count - 1] - curve->x[0]) / COLUMNS;
    *thinned = *thinned || columns || step > 1;
    for (size_t i = 0, end; i < curve->count; i = end) {
        end = i + step;
        if (!columns || !isfinite(curve->y[i])) {
            kept[count++] = i;
            continue;
        }
        while (end < curve->count && isfinite(curve->y[end]) && curve->x[end] < curve->x[i] + width)
            end++;
        count += keep_column(curve, i, end, kept + count);
    }
    return count;
}

/* Lists those of the numbers that are drawn, each moved by so much. */
static json_t *list_of(const double *values, const size_t *kept, size_t count, double moved)
{
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(list, number(values[kept[i]] + moved));
    return list;
}

static json_t *describe_curve(const report_curve *curve, bool *thinned)
{
    size_t *kept = memory_alloc(4 * curve->count * sizeof *kept);
    const size_t count = choose_points(curve, kept, thinned);
    json_t *made =
        json_pack("{s:o, s:i, s:i, s:s, s:s*, s:o, s:o}", "name", results_json_text(curve->label),
                  "colour", curve->colour, "dash", curve->dash, "style",
                  curve->dots   ? "dots"
                  : curve->bars ? "bars"
                                : "line",
                  "live", *curve->live ? curve->live : NULL, "x", list_of(curve->x, kept, count, 0),
                  "y", list_of(curve->y, kept, count, 0));
    if (curve->bar)
        json_object_set_new(made, "bar", list_of(curve->bar, kept, count, 0));
    if (curve->bars) {
        const double half = 0.5 * curve->width;
        json_object_set_new(made, "from", list_of(curve->x, kept, count, -half));
        json_object_set_new(made, "to", list_of(curve->x, kept, count, half));
    }
    free(kept);
    return made;
}

/* Says whether the values along y are above 0 and span so much that a linear axis hides some. */
static bool is_wide(const report_plot *plot)
{
    enum { SPAN = 30, MOST = 10000 }; /* beyond the most, what is small is as good as 0 */
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < plot->count; k++)
        for (size_t i = 0; i < plot->curves[k].count; i++) {
            double y = plot->curves[k].y[i];
            low = fmin(low, y);
            high = fmax(high, y);
        }
    return low > 0 && high > SPAN * low && high < MOST * low && !(plot->y0 < plot->y1) &&
           !plot->curves[0].bars;
}

/* An axis; an end that is not finite is left to the script. */
static json_t *describe_axis(const char *label, bool log, double low, double high)
{
    return json_pack("{s:o, s:i, s:o*, s:o*}", "label", results_json_text(label), "log", (int)log,
                     "low", isfinite(low) ? number(low) : NULL, "high",
                     isfinite(high) ? number(high) : NULL);
}

void report_plot_write(report_page *page, const report_plot *plot)
{
    const bool ranged = plot->x0 < plot->x1, bound = plot->y0 < plot->y1;
    if (plot->count == 0)
        return;
    json_t *marks = json_array(), *curves = json_array(), *names = json_array();
    for (size_t i = 0; plot->x_names && i < plot->curves[0].count; i++)
        json_array_append_new(names, results_json_text(plot->x_names[i]));
    for (size_t i = 0; i < plot->mark_count; i++)
        json_array_append_new(marks,
                              json_pack("[o, s]", number(plot->marks[i]), plot->mark_names[i]));
    for (size_t k = 0; k < plot->count; k++)
        json_array_append_new(curves, describe_curve(&plot->curves[k], &page->thinned));
    json_t *figure =
        json_pack("{s:s, s:o, s:s*, s:o, s:o, s:O*, s:o*, s:i, s:o, s:o}", "sort", "curves",
                  "title", results_json_text(plot->title), "class", plot->class, "x",
                  describe_axis(plot->x_label, plot->decades, ranged ? plot->x0 : NAN,
                                ranged ? plot->x1 : NAN),
                  "y",
                  describe_axis(plot->y_label, is_wide(plot) || plot->y_decades,
                                bound             ? plot->y0
                                : plot->from_zero ? 0
                                                  : NAN,
                                bound ? plot->y1 : NAN),
                  "names", plot->x_names ? names : NULL, "limit",
                  plot->limit_name ? json_pack("{s:o, s:o}", "at", number(plot->limit), "name",
                                               results_json_text(plot->limit_name))
                                   : NULL,
                  "room", plot->curves[0].dots, "marks", marks, "curves", curves);
    json_decref(names);
    report_put_figure(page, figure);
}

/* A side of a map: its label, and where its cells are. */
static json_t *describe_side(const char *label, const double *at, size_t count, size_t step)
{
    json_t *list = json_array();
    for (size_t i = 0; i < count; i += step)
        json_array_append_new(list, number(at[i]));
    return json_pack("{s:o, s:o}", "label", results_json_text(label), "at", list);
}

void report_map_write(report_page *page, const report_map *map)
{
    size_t step_x = map->columns / MOST_CELLS + 1, step_y = map->rows / MOST_CELLS + 1;
    bool log = map->low > 0 && map->high > 30 * map->low;
    if (!(map->low <= map->high))
        return;
    page->thinned = page->thinned || step_x > 1 || step_y > 1;
    json_t *standing = json_array(), *values = json_array();
    for (size_t r = 0; r < map->rows; r += step_y) {
        char letters[MOST_CELLS + 1];
        size_t used = 0;
        json_t *row = json_array();
        for (size_t c = 0; c < map->columns; c += step_x) {
            json_array_append_new(row, number(map->values[r * map->columns + c]));
            letters[used++] = (char)('0' + map->standing[r * map->columns + c]);
        }
        json_array_append_new(standing, json_stringn(letters, used));
        json_array_append_new(values, row);
    }
    json_t *value = describe_axis(map->value_label, log, map->low, map->high);
    report_put_figure(
        page,
        json_pack("{s:s, s:i, s:o, s:o, s:o, s:o, s:o*, s:o*, s:o, s:o}", "sort", "map", "height",
                  300, "title", results_json_text(map->title), "x",
                  describe_side(map->x_label, map->x, map->columns, step_x), "y",
                  describe_side(map->y_label, map->y, map->rows, step_y), "value", value, "mark",
                  isfinite(map->mark) ? number(map->mark) : NULL, "best",
                  map->best < 0
                      ? NULL
                      : json_pack("[I, I]", (json_int_t)((size_t)map->best % map->columns / step_x),
                                  (json_int_t)((size_t)map->best / map->columns / step_y)),
                  "standing", standing, "values", values));
}
