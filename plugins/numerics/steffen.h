/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slopes of the piecewise cubic that stays between neighbouring values: M. Steffen 1990, Astron.
   Astrophys. 239, 443-450. */
#ifndef NUMERICS_STEFFEN_H
#define NUMERICS_STEFFEN_H

#include <math.h>
#include <stddef.h>

/* Eqs (8) and (11): slope at a point between intervals of lengths h0, h1 and secants s0, s1. */
static inline double numerics_steffen_inner(double h0, double s0, double h1, double s1)
{
    double p = (s0 * h1 + s1 * h0) / (h0 + h1);
    double bound = fmin(fmin(fabs(s0), fabs(s1)), fabs(p) / 2);
    return (copysign(1, s0) + copysign(1, s1)) * bound;
}

/* Eqs (24) to (27): slope at the outer end of an end interval with length h0 and secant s0; its
   neighbour has h1 and s1. */
static inline double numerics_steffen_end(double h0, double s0, double h1, double s1)
{
    double p = s0 + (s0 - s1) * h0 / (h0 + h1);
    if (p * s0 <= 0)
        return 0;
    return fabs(p) > 2 * fabs(s0) ? 2 * s0 : p;
}

/* Slopes of n values at increasing x; 0 for a single value. */
static inline void numerics_steffen_slopes(size_t n, const double *x, const double *y,
                                           double *slope)
{
    double h0 = n > 1 ? x[1] - x[0] : 1, s0 = n > 1 ? (y[1] - y[0]) / h0 : 0;
    slope[0] = slope[n - 1] = s0;
    for (size_t i = 1; i + 1 < n; i++) {
        double h1 = x[i + 1] - x[i], s1 = (y[i + 1] - y[i]) / h1;
        if (i == 1)
            slope[0] = numerics_steffen_end(h0, s0, h1, s1);
        slope[i] = numerics_steffen_inner(h0, s0, h1, s1);
        if (i + 2 == n)
            slope[n - 1] = numerics_steffen_end(h1, s1, h0, s0);
        h0 = h1;
        s0 = s1;
    }
}

#endif
