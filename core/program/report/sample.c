/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Recognises samples of inputs, and computes the distribution of values over a sample. */
#include "page.h"

#include "../memory/memory.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_numeric(const results_view *view, const results_view_axis *axis)
{
    for (size_t i = 0; i < view->lengths[axis->dimension]; i++)
        if (!isfinite(report_axis_number(axis, i)))
            return false;
    return true;
}

/* Rows of a load spectrum are weighted by their times, so they are not a sample. */
static bool is_spectrum(const results_view *view)
{
    for (size_t i = 0; i < view->figures_count; i++)
        if (!strncmp(view->figures[i]->name, "spectrum.", 9))
            return true;
    return false;
}

/* Returns whether the cases are a sample: not ordered along any input, and of equal weight. */
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
            rises = rises && report_axis_number(axis, i) >= report_axis_number(axis, i - 1);
            falls = falls && report_axis_number(axis, i) <= report_axis_number(axis, i - 1);
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
