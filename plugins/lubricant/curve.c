/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Piecewise cubics: M. Steffen 1990, Astron. Astrophys. 239, 443-450. */
#include "curve.h"

#include "../numerics/interval.h"
#include "../numerics/steffen.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Returns the slope of the chord from point i to the next. */
static double secant(const lubricant_curve *c, size_t i)
{
    return (c->y[i + 1] - c->y[i]) / (c->x[i + 1] - c->x[i]);
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
    numerics_steffen_slopes(n, x, y, c->slope);
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

/* A cubic in the distance from a point, valid for low <= x < high. */
typedef struct piece {
    double low, high, from, y, slope, square, cube;
} piece;

static piece piece_at(const lubricant_curve *c, double x)
{
    const size_t last = c->n - 1;
    if (!(x >= c->x[0])) /* also true for NaN */
        return (piece){-HUGE_VAL, c->x[0], c->x[0], c->y[0], c->slope[0], 0, 0};
    if (x >= c->x[last])
        return (piece){c->x[last], HUGE_VAL, c->x[last], c->y[last], c->slope[last], 0, 0};
    size_t i = numerics_interval(c->n, c->x, x);
    return (piece){c->x[i], c->x[i + 1], c->x[i], c->y[i], c->slope[i], c->square[i], c->cube[i]};
}

FF_SIMD
static void on_piece(const piece *p, size_t n, const double *restrict x, double *restrict y,
                     double *restrict slope)
{
    const double from = p->from, at = p->y, tilt = p->slope, square = p->square, cube = p->cube;
    for (size_t k = 0; k < n; k++) {
        double d = x[k] - from;
        slope[k] = tilt + d * (2 * square + d * 3 * cube);
        y[k] = at + d * (tilt + d * (square + d * cube));
    }
}

void lubricant_curve_values(const lubricant_curve *c, size_t n, const double *x, double *y,
                            double *slope)
{
    for (size_t k = 0, end; k < n; k = end) {
        piece p = piece_at(c, x[k]);
        for (end = k + 1; end < n && x[end] >= p.low && x[end] < p.high; end++)
            ;
        on_piece(&p, end - k, x + k, y + k, slope + k);
    }
}
