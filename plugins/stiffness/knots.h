/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A table over one mesh cycle as a periodic function. Phase 1 is phase 0 of the next cycle. A
 * phase given twice is a jump: the first sample is the value before it, the second the value
 * after; so are the samples at 1 and at 0 when both are given.
 */
#ifndef STIFFNESS_KNOTS_H
#define STIFFNESS_KNOTS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct stiffness_knots {
    size_t count;
    double *phase;          /* in [0, 1), increasing */
    size_t *before, *after; /* samples that hold the values on both sides; equal: no jump */
} stiffness_knots;

/* Returns NULL, or a sentence that says what is wrong with sample *bad ("" when out of memory). */
const char *stiffness_knots_make(stiffness_knots *knots, size_t count, const double *phase,
                                 size_t *bad);
void stiffness_knots_free(stiffness_knots *knots);

/* `value` over the samples, linear between the knots. `side` matters at a knot alone. */
double stiffness_knots_linear(const stiffness_knots *knots, const double *value, double phase,
                              int side);

/* Slopes of the piecewise cubic of Steffen at the knots, `count` before and `count` after them:
   it stays between neighbouring values, has a continuous slope where there is no jump, and is
   one-sided at jumps. */
void stiffness_knots_slopes(const stiffness_knots *knots, const double *value, double *before,
                            double *after);
double stiffness_knots_cubic(const stiffness_knots *knots, const double *value,
                             const double *slope_before, const double *slope_after, double phase,
                             int side);

bool stiffness_knots_jump(const stiffness_knots *knots, const double *value, size_t knot);
/* True where the linear function bends or jumps by more than rounding. */
bool stiffness_knots_kink(const stiffness_knots *knots, const double *value, size_t knot);

#endif
