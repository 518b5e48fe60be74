/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The derivative of a law by finite differences. */
#ifndef SLOPE_H
#define SLOPE_H

#include "law-checks.h"

/* The value of a function along one axis through a point. */
typedef struct conformance_line {
    const conformance_function *function;
    const void *table;
    double speed, point[CONFORMANCE_AXES];
    size_t axis;
} conformance_line;

double conformance_value_at(const conformance_line *l, double x, double out[CONFORMANCE_RESULTS]);

/* Compares the derivative `claimed` with finite differences about the point; `h` is the first step.
   Returns 0: they agree; 1: they differ; 2: the differences are too inaccurate to decide, for
   example near a kink. *found: the derivative by differences. */
int conformance_compare_slope(const conformance_line *l, double claimed, double h, double *found);

#endif
