/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far one answer is from another: relative, at the points of the reference. */
#ifndef STUDY_COMPARE_H
#define STUDY_COMPARE_H

#include <stdbool.h>
#include <stddef.h>

/* An answer: a scalar (rank 0) or a series. */
typedef struct study_series {
    size_t rank, count;
    const double *at; /* what it is plotted against, which never falls; NULL means the index */
    const double *value;
} study_series;

typedef struct study_difference {
    double largest, rms; /* relative */
    double judged;       /* the one of them by which the study judges */
} study_difference;

double study_largest_magnitude(const double *values, size_t count);
/* Returns what an error at a value is relative to, in a series whose largest magnitude is `most`.
 */
double study_error_scale(double value, double most, size_t rank);
double study_interpolate(const study_series *series, double x, bool right);
/* False when the two cannot be compared, or their difference is not finite. */
bool study_compare(const study_series *answer, const study_series *reference,
                   study_difference *difference);

#endif
