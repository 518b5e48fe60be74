/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far one answer is from another: relative, at the points of the reference. */
#ifndef ACCURACY_COMPARE_H
#define ACCURACY_COMPARE_H

#include <stdbool.h>
#include <stddef.h>

/* An answer: a scalar (rank 0) or a series. */
typedef struct accuracy_series {
    size_t rank, count;
    const double *at; /* what it is plotted against, which never falls; NULL means the index */
    const double *value;
    double zero; /* what shares of a value are counted from */
} accuracy_series;

typedef struct accuracy_difference {
    double largest, rms; /* relative */
    double judged;       /* the one of them by which the study judges */
} accuracy_difference;

double accuracy_largest_magnitude(const double *values, size_t count, double zero);
/* Returns what an error at a value is relative to, in a series whose largest magnitude is `most`.
 */
double accuracy_error_scale(double value, double most, size_t rank);
/* What an answer is off by, each number relative to its own: typical of a series (estimate.h), and
   the largest. */
double accuracy_relative(const double *off, const accuracy_series *answer, double *largest);
double accuracy_interpolate(const accuracy_series *series, double x, bool right);
/* False when the two cannot be compared, or their difference is not finite. */
bool accuracy_compare(const accuracy_series *answer, const accuracy_series *reference,
                      accuracy_difference *difference);

#endif
