/* SPDX-License-Identifier: MIT */
/* Natural bounds: what the numbers of an output cannot be, by its row. */
#include "build.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* How far the number lies outside of the natural bounds of its row; 0: within. Rounding at a bound
   is no violation. */
static double beyond(const ff_port *row, double value)
{
    const bool point = !(row->flags & FF_DIFFERENCE) && !strcmp(row->unit, "K");
    const bool bounded = row->min < row->max;
    const double rounding = 1e-12;
    double least = bounded ? row->min : -INFINITY, most = bounded ? row->max : INFINITY;
    double scale = fmax(isfinite(least) ? fabs(least) : 0, isfinite(most) ? fabs(most) : 0);
    if (point)
        least = fmax(least, 0);
    double outside = fmax(least - value, value - most);
    return outside > rounding * scale ? outside : 0;
}

static void print_bounds(const ff_port *row, char *text, size_t size)
{
    if (!(row->min < row->max))
        snprintf(text, size, "it lies below 0 K");
    else if (isinf(row->max))
        snprintf(text, size, "it cannot be below %g", row->min);
    else if (isinf(row->min))
        snprintf(text, size, "it cannot be above %g", row->max);
    else
        snprintf(text, size, "it can only be from %g to %g", row->min, row->max);
}

void fe_judge_bounds(ff_stage *stage)
{
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const ff_result *result = &stage->results[i];
        const ff_port *row = result->row;
        size_t worst = 0;
        double most = 0;
        for (size_t k = 0; result->data && k < result->count; k++) {
            double outside = beyond(row, result->data[k]);
            worst = outside > most ? k : worst;
            most = fmax(most, outside);
        }
        if (!(most > 0))
            continue;
        char bounds[80], text[160];
        print_bounds(row, bounds, sizeof bounds);
        snprintf(text, sizeof text, result->rank ? "%s, at index %zu" : "%s", bounds, worst);
        double value = result->data[worst];
        ff_add_quality(stage, row->name, value, value > row->min ? row->max : fmax(row->min, 0),
                       FF_BAD, text);
    }
}
