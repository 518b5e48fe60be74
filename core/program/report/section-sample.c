/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scalar over a sample of inputs: how it is distributed, which input it follows, and its points
   over each of them. */
#include <flankfilm/engine.h>

#include "page.h"

#include "../memory/memory.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_INPUTS = 12, MOST_BINS = 30 };

/* Returns a value of an input as a number: of an input with several values, such as the relief of
   two gears, that which it was given in words; NaN when it has none. */
static double number_of(const results_view_axis *axis, size_t point)
{
    double number;
    const char *end;
    if (axis->values)
        return axis->values[point];
    return ff_number_parse(axis->words[point], &number, &end) ? number : (double)NAN;
}

static bool is_numeric(const results_view *view, const results_view_axis *axis)
{
    for (size_t i = 0; i < view->lengths[axis->dimension]; i++)
        if (!isfinite(number_of(axis, i)))
            return false;
    return true;
}

/* Rows of a load spectrum count by their times. */
static bool is_spectrum(const results_view *view)
{
    for (size_t i = 0; i < view->figures_count; i++)
        if (!strncmp(view->figures[i]->name, "spectrum.", 9))
            return true;
    return false;
}

/* Says whether the points stand in no order along any input, and each counts as much. */
bool report_is_sample(const results_view *view)
{
    size_t inputs = 0;
    if (view->dimension_count != 1 || view->lengths[0] < 8 || is_spectrum(view))
        return false;
    for (size_t a = 0; a < view->axis_count; a++) {
        const results_view_axis *axis = view->axes[a];
        bool rises = true, falls = true;
        if (!is_numeric(view, axis))
            continue;
        for (size_t i = 1; i < view->lengths[0]; i++) {
            rises = rises && number_of(axis, i) >= number_of(axis, i - 1);
            falls = falls && number_of(axis, i) <= number_of(axis, i - 1);
        }
        if (rises || falls)
            return false;
        inputs++;
    }
    return inputs > 0;
}

double *report_sort(const double *values, size_t count, size_t *kept)
{
    double *list = memory_alloc((count + 1) * sizeof *list);
    *kept = 0;
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]))
            list[(*kept)++] = values[i];
    memory_sort(list, *kept, sizeof *list);
    return list;
}

double report_percentile(const double *list, size_t count, double percent)
{
    assert(count > 0 && percent >= 0 && percent <= 100);
    double at = percent / 100 * (double)(count - 1);
    size_t low = (size_t)at;
    return low + 1 < count ? list[low] + (at - (double)low) * (list[low + 1] - list[low])
                           : list[count - 1];
}

static void draw_histogram(const report_scalar *f)
{
    static const char *const names[] = {"5 %", "50 %", "95 %"};
    static const double percents[] = {5, 50, 95};
    const study_readable one = {1, 0, ""};
    size_t kept, bins;
    double *list = report_sort(f->values, f->count, &kept), x[MOST_BINS], y[MOST_BINS] = {0};
    report_plot plot = {.count = 0, .from_zero = true};
    bins = kept < 2 ? 1 : (size_t)fmin(ceil(sqrt((double)kept)) + 1, MOST_BINS);
    double width = kept > 1 ? (list[kept - 1] - list[0]) / (double)bins : 0;
    if (width > 0) {
        for (size_t i = 0; i < bins; i++)
            x[i] = list[0] + ((double)i + 0.5) * width;
        for (size_t i = 0; i < kept; i++)
            y[(size_t)fmin((list[i] - list[0]) / width, (double)bins - 1)]++;
        report_curve *curve = report_plot_add(&plot, &f->unit, x, &one, y, bins);
        curve->bars = true;
        curve->width = fabs(f->unit.factor) * width;
        for (size_t i = 0; i < 3; i++) {
            plot.mark_names[plot.mark_count] = names[i];
            plot.marks[plot.mark_count++] =
                report_convert(&f->unit, report_percentile(list, kept, percents[i]));
        }
        snprintf(plot.title, sizeof plot.title, "%.150s: how it is spread", f->title);
        snprintf(plot.x_label, sizeof plot.x_label, "%s", f->label);
        snprintf(plot.y_label, sizeof plot.y_label, "cases");
        report_plot_write(f->page, &plot);
    }
    report_plot_free(&plot);
    free(list);
}

/* Writes to `ranks` the place of each value among those of the cases that count. */
static void rank(const double *values, const bool *counts, size_t count, double *ranks)
{
    for (size_t i = 0; i < count; i++) {
        double below = 0, equal = 0;
        for (size_t k = 0; counts[i] && k < count; k++)
            if (counts[k]) {
                below += values[k] < values[i];
                equal += values[k] == values[i];
            }
        ranks[i] = below + 0.5 * equal;
    }
}

static double correlation(const double *x, const double *y, const bool *counts, size_t count)
{
    double n = 0, mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
    for (size_t i = 0; i < count; i++)
        if (counts[i]) {
            n++;
            mx += (x[i] - mx) / n;
            my += (y[i] - my) / n;
        }
    for (size_t i = 0; i < count; i++)
        if (counts[i]) {
            xx += (x[i] - mx) * (x[i] - mx);
            yy += (y[i] - my) * (y[i] - my);
            xy += (x[i] - mx) * (y[i] - my);
        }
    return xx > 0 && yy > 0 ? xy / sqrt(xx * yy) : 0;
}

/* Ranks cost the square of the cases; of many, the first will do. */
static void draw_bars(const report_scalar *f)
{
    enum { MOST_RANKED = 2000 };
    const results_view *view = f->page->view;
    size_t count = f->count < MOST_RANKED ? f->count : MOST_RANKED, inputs = 0;
    bool *counts = memory_alloc(count * sizeof *counts);
    double *x = memory_alloc(count * sizeof *x), *a = memory_alloc(count * sizeof *a);
    double *b = memory_alloc(count * sizeof *b), at[MOST_INPUTS], share[MOST_INPUTS];
    char names[MOST_INPUTS][REPORT_TEXT_SIZE], words[REPORT_TEXT_SIZE];
    const study_readable one = {1, 0, ""};
    report_plot plot = {.y0 = -1, .y1 = 1};
    for (size_t i = 0; i < count; i++)
        counts[i] = isfinite(f->values[i]);
    rank(f->values, counts, count, a);
    for (size_t k = 0; k < view->axis_count && inputs < MOST_INPUTS; k++) {
        const results_view_axis *axis = view->axes[k];
        if (!is_numeric(view, axis))
            continue;
        for (size_t i = 0; i < count; i++)
            x[i] = number_of(axis, results_view_point(view, i, axis->dimension));
        rank(x, counts, count, b);
        at[inputs] = (double)inputs;
        share[inputs] = correlation(a, b, counts, count);
        snprintf(names[inputs++], REPORT_TEXT_SIZE, "%s", report_plain_name(axis->path, words));
    }
    report_curve *curve = report_plot_add(&plot, &one, at, &one, share, inputs);
    if (curve) {
        curve->bars = true;
        curve->width = 0.7;
        plot.x_names = (const char(*)[REPORT_TEXT_SIZE])names;
        snprintf(plot.title, sizeof plot.title, "%.150s: what it follows", f->title);
        snprintf(plot.y_label, sizeof plot.y_label, "rank correlation");
        report_plot_write(f->page, &plot);
    }
    report_plot_free(&plot);
    free(counts);
    free(x);
    free(a);
    free(b);
}

static void draw_dots(const report_scalar *f, const results_view_axis *axis)
{
    const results_view *view = f->page->view;
    char words[REPORT_TEXT_SIZE];
    double size = 0, *x = memory_alloc(f->count * sizeof *x);
    report_plot plot = {.count = 0};
    for (size_t c = 0; c < f->count; c++) {
        x[c] = number_of(axis, results_view_point(view, c, axis->dimension));
        size = fmax(size, fabs(x[c]));
    }
    double number;
    const char *end = "";
    study_readable unit = {1, 0, ""};
    if (axis->values)
        unit = report_unit_for(axis->path, axis->unit, size);
    else if (ff_number_parse(axis->words[0], &number, &end))
        unit.unit = end + strspn(end, " ");
    report_label(report_plain_name(axis->path, words), &unit, plot.x_label);
    snprintf(plot.title, sizeof plot.title, "%.100s over %.80s", f->title,
             report_plain_name(axis->path, words));
    snprintf(plot.y_label, sizeof plot.y_label, "%s", f->label);
    report_curve *curve = report_plot_add(&plot, &unit, x, &f->unit, f->values, f->count);
    if (curve)
        curve->dots = true;
    report_plot_write(f->page, &plot);
    report_plot_free(&plot);
    free(x);
}

void report_write_sample(const report_scalar *f)
{
    report_page *page = f->page;
    const results_view *view = page->view;
    size_t drawn = 0;
    draw_histogram(f);
    draw_bars(f);
    report_print(
        page->out,
        "<details class=\"broad\"><summary>%s over each input</summary>\n<div class=\"figures\">\n",
        f->title);
    for (size_t a = 0; a < view->axis_count && drawn < MOST_INPUTS; a++)
        if (is_numeric(view, view->axes[a])) {
            draw_dots(f, view->axes[a]);
            drawn++;
        }
    fputs("</div></details>\n", page->out);
}
