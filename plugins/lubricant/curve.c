/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Piecewise cubics: M. Steffen 1990, Astron. Astrophys. 239, 443-450. */
#include "curve.h"

#include "../numerics/interval.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Slope between point i and the next. */
static double secant(const lubricant_curve *c, size_t i)
{
    return (c->y[i + 1] - c->y[i]) / (c->x[i + 1] - c->x[i]);
}

/* Steffen, equation 11: that of a parabola through three points, cut down where it would overshoot.
 */
static double inner_slope(const lubricant_curve *c, size_t i)
{
    double before = secant(c, i - 1), after = secant(c, i);
    double h = c->x[i] - c->x[i - 1], next = c->x[i + 1] - c->x[i];
    double parabola = (before * next + after * h) / (h + next);
    if (before * after <= 0)
        return 0;
    return copysign(fmin(2 * fmin(fabs(before), fabs(after)), fabs(parabola)), before);
}

/* Steffen, equations 24 to 27, for the first point, or the last. */
static double end_slope(const lubricant_curve *c, bool last)
{
    size_t i = last ? c->n - 2 : 0, j = last ? c->n - 3 : 1;
    double near = secant(c, i), far = secant(c, j);
    double h = c->x[i + 1] - c->x[i], next = c->x[j + 1] - c->x[j];
    double share = h / (h + next), parabola = near * (1 + share) - far * share;
    if (parabola * near <= 0)
        return 0;
    return fabs(parabola) > 2 * fabs(near) ? 2 * near : parabola;
}

bool lubricant_curve_make(lubricant_curve *c, size_t n, const double *x, const double *y)
{
    double *memory = malloc(5 * n * sizeof *memory);
    if (!memory)
        return false;
    *c = (lubricant_curve){.n = n,
                           .x = memory,
                           .y = memory + n,
                           .slope = memory + 2 * n,
                           .square = memory + 3 * n,
                           .cube = memory + 4 * n};
    memcpy(c->x, x, n * sizeof *x);
    memcpy(c->y, y, n * sizeof *y);
    c->slope[0] = n > 1 ? secant(c, 0) : 0;
    c->slope[n - 1] = c->slope[0];
    for (size_t i = 1; i + 1 < n; i++)
        c->slope[i] = inner_slope(c, i);
    if (n > 2) {
        c->slope[0] = end_slope(c, false);
        c->slope[n - 1] = end_slope(c, true);
    }
    for (size_t i = 0; i + 1 < n; i++) {
        double h = c->x[i + 1] - c->x[i], s = secant(c, i), here = c->slope[i];
        c->square[i] = (3 * s - 2 * here - c->slope[i + 1]) / h;
        c->cube[i] = (here + c->slope[i + 1] - 2 * s) / (h * h);
    }
    return true;
}

void lubricant_curve_free(lubricant_curve *c)
{
    free(c->x);
    *c = (lubricant_curve){.n = 0};
}

void lubricant_curve_values(const lubricant_curve *c, size_t n, const double *x, double *y,
                            double *slope)
{
    const size_t last = c->n - 1;
    size_t i = 0;
    for (size_t k = 0; k < n; k++) {
        double at = x[k], square = 0, cube = 0;
        if (!(at > c->x[0] && at < c->x[last])) {
            i = at >= c->x[last] ? last : 0;
        } else {
            if (i == last || !(at >= c->x[i] && at < c->x[i + 1]))
                i = numerics_interval(c->n, c->x, at);
            square = c->square[i];
            cube = c->cube[i];
        }
        double d = at - c->x[i];
        slope[k] = c->slope[i] + d * (2 * square + d * 3 * cube);
        y[k] = c->y[i] + d * (c->slope[i] + d * (square + d * cube));
    }
}
