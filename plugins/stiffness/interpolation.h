/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A table over one mesh cycle as a periodic function, piecewise linear or cubic. Phase 1 is phase 0
   of the next cycle. A repeated phase is a jump: the first sample is the value before it, the
   second the value after it. Samples at both 1 and 0 are also a jump. */
#ifndef STIFFNESS_INTERPOLATION_H
#define STIFFNESS_INTERPOLATION_H

#include <stdbool.h>
#include <stddef.h>

/* The distinct phases of a table, which are the breakpoints of its pieces. */
typedef struct stiffness_table_phases {
    size_t count;
    double *phase;          /* in [0, 1), increasing */
    size_t *before, *after; /* indices of the samples with the values before and after each phase */
} stiffness_table_phases;

/* Returns NULL, or a sentence about the error in sample *bad; "" if memory is short. */
const char *stiffness_table_phases_make(stiffness_table_phases *points, size_t count,
                                        const double *phase, size_t *bad);
void stiffness_table_phases_free(stiffness_table_phases *points);

/* Evaluates the function with these sample values, linear between the breakpoints. `side` matters
   only at breakpoints. */
double stiffness_linear_at(const stiffness_table_phases *points, const double *value, double phase,
                           int side);

/* Computes the slopes of Steffen's piecewise cubic (1990): `before` and `after` have one slope for
   each breakpoint. The cubic stays between neighbouring values, has a continuous slope except at
   jumps, and uses no value from beyond a jump. */
void stiffness_steffen_slopes(const stiffness_table_phases *points, const double *value,
                              double *before, double *after);
double stiffness_cubic_at(const stiffness_table_phases *points, const double *value,
                          const double *slope_before, const double *slope_after, double phase,
                          int side);

/* Whether the function jumps at breakpoint i. */
bool stiffness_jumps_at(const stiffness_table_phases *points, const double *value, size_t i);
/* Whether the linear function jumps at breakpoint i, or its slope changes by more than rounding. */
bool stiffness_slope_changes_at(const stiffness_table_phases *points, const double *value,
                                size_t i);

#endif
