/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Describes figures as JSON, for script.js to draw. Of a curve with more points than a drawing has
 * columns, each column keeps its first, lowest, highest and last one, so that no peak is lost.
 */
#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 700, MOST_DOTS = 3000, MOST_CELLS = 200 };

report_curve *report_plot_add(report_plot *plot, const results_readable *x_unit, const double *x,
                              const results_readable *y_unit, const double *y, size_t count)
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

void report_curve_bar(report_curve *curve, const results_readable *y_unit, const double *bar)
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

void report_put_json_text(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text; text++)
        if (strchr("\"\\<>&'", *text) || (unsigned char)*text < 32)
            fprintf(out, "\\u%04x", (unsigned)*text);
        else
            fputc(*text, out);
    fputc('"', out);
}

static void put_number(FILE *out, double value, size_t i)
{
    if (isfinite(value))
        fprintf(out, i ? ",%.6g" : "%.6g", value);
    else
        fputs(i ? ",null" : "null", out);
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

static void put_list(FILE *out, const char *name, const double *values, const size_t *kept,
                     size_t count)
{
    fprintf(out, ",\"%s\":[", name);
    for (size_t i = 0; i < count; i++)
        put_number(out, values[kept[i]], i);
    fputc(']', out);
}

static void put_curve(report_page *page, const report_curve *curve)
{
    FILE *out = page->out;
    size_t *kept = memory_alloc(4 * curve->count * sizeof *kept);
    size_t count = choose_points(curve, kept, &page->thinned);
    fputs("{\"name\":", out);
    report_put_json_text(out, curve->label);
    fprintf(out, ",\"colour\":%d,\"dash\":%d,\"style\":\"%s\"", curve->colour, curve->dash,
            curve->dots   ? "dots"
            : curve->bars ? "bars"
                          : "line");
    if (*curve->live)
        fprintf(out, ",\"live\":\"%s\"", curve->live);
    put_list(out, "x", curve->x, kept, count);
    put_list(out, "y", curve->y, kept, count);
    if (curve->bar)
        put_list(out, "bar", curve->bar, kept, count);
    for (int side = 0; side < 2 && curve->bars; side++) {
        fprintf(out, ",\"%s\":[", side ? "to" : "from");
        for (size_t i = 0; i < count; i++)
            put_number(out, curve->x[kept[i]] + (side - 0.5) * curve->width, i);
        fputc(']', out);
    }
    free(kept);
    fputc('}', out);
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

static void put_axis(FILE *out, const char *name, const char *label, bool log, double low,
                     double high)
{
    fprintf(out, "\"%s\":{\"label\":", name);
    report_put_json_text(out, label);
    fprintf(out, ",\"log\":%d", log);
    if (isfinite(low))
        fprintf(out, ",\"low\":%.6g", low);
    if (isfinite(high))
        fprintf(out, ",\"high\":%.6g", high);
    fputs("},", out);
}

void report_figure_begin(report_page *page, const char *title, const char *class)
{
    page->figures++;
    fprintf(page->out, "<figure%s%s%s><figcaption><span>", class ? " class=\"" : "",
            class ? class : "", class ? "\"" : "");
    report_put_text(page->out, title);
    fputs("</span></figcaption><script type=\"application/json\">", page->out);
}

void report_figure_end(report_page *page)
{
    fputs("</script></figure>\n", page->out);
}

void report_plot_write(report_page *page, const report_plot *plot)
{
    FILE *out = page->out;
    bool ranged = plot->x0<plot->x1, dots = plot->count> 0 && plot->curves[0].dots;
    if (plot->count == 0)
        return;
    report_figure_begin(page, plot->title, plot->class);
    fputs("{\"sort\":\"curves\",", out);
    put_axis(out, "x", plot->x_label, plot->decades, ranged ? plot->x0 : NAN,
             ranged ? plot->x1 : NAN);
    bool bound = plot->y0 < plot->y1;
    put_axis(out, "y", plot->y_label, is_wide(plot) || plot->y_decades,
             bound             ? plot->y0
             : plot->from_zero ? 0
                               : NAN,
             bound ? plot->y1 : NAN);
    for (size_t i = 0; plot->x_names && i < plot->curves[0].count; i++) {
        fputs(i ? "," : "\"names\":[", out);
        report_put_json_text(out, plot->x_names[i]);
    }
    fputs(plot->x_names ? "]," : "", out);
    if (plot->limit_name) {
        fprintf(out, "\"limit\":{\"at\":%.6g,\"name\":", plot->limit);
        report_put_json_text(out, plot->limit_name);
        fputs("},", out);
    }
    fprintf(out, "%s\"marks\":[", dots ? "\"room\":1," : "");
    for (size_t i = 0; i < plot->mark_count; i++) {
        fprintf(out, "%s[%.6g,", i ? "," : "", plot->marks[i]);
        report_put_json_text(out, plot->mark_names[i]);
        fputc(']', out);
    }
    fputs("],\"curves\":[", out);
    for (size_t k = 0; k < plot->count; k++) {
        fputs(k ? ",\n" : "\n", out);
        put_curve(page, &plot->curves[k]);
    }
    fputs("]}", out);
    report_figure_end(page);
}

static void put_side(FILE *out, const char *name, const char *label, const double *at, size_t count,
                     size_t step)
{
    fprintf(out, "\"%s\":{\"label\":", name);
    report_put_json_text(out, label);
    fputs(",\"at\":[", out);
    for (size_t i = 0; i < count; i += step)
        put_number(out, at[i], i);
    fputs("]},", out);
}

void report_map_write(report_page *page, const report_map *map)
{
    FILE *out = page->out;
    size_t step_x = map->columns / MOST_CELLS + 1, step_y = map->rows / MOST_CELLS + 1;
    bool log = map->low > 0 && map->high > 30 * map->low;
    if (!(map->low <= map->high))
        return;
    page->thinned = page->thinned || step_x > 1 || step_y > 1;
    report_figure_begin(page, map->title, NULL);
    fputs("{\"sort\":\"map\",\"height\":300,", out);
    put_side(out, "x", map->x_label, map->x, map->columns, step_x);
    put_side(out, "y", map->y_label, map->y, map->rows, step_y);
    fputs("\"value\":{\"label\":", out);
    report_put_json_text(out, map->value_label);
    fprintf(out, ",\"log\":%d,\"low\":%.6g,\"high\":%.6g},", log, map->low, map->high);
    if (isfinite(map->mark))
        fprintf(out, "\"mark\":%.6g,", map->mark);
    if (map->best >= 0)
        fprintf(out, "\"best\":[%zu,%zu],", (size_t)map->best % map->columns / step_x,
                (size_t)map->best / map->columns / step_y);
    fputs("\"standing\":[", out);
    for (size_t r = 0; r < map->rows; r += step_y) {
        fputs(r ? ",\"" : "\"", out);
        for (size_t c = 0; c < map->columns; c += step_x)
            fprintf(out, "%d", (int)map->standing[r * map->columns + c]);
        fputc('"', out);
    }
    fputs("],\"values\":[", out);
    for (size_t r = 0; r < map->rows; r += step_y) {
        fputs(r ? ",\n[" : "[", out);
        for (size_t c = 0; c < map->columns; c += step_x)
            put_number(out, map->values[r * map->columns + c], c);
        fputc(']', out);
    }
    fputs("]}", out);
    report_figure_end(page);
}
