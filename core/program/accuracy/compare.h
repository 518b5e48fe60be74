/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Relative difference of two answers at the points of the reference. */
#ifndef ACCURACY_COMPARE_H
#define ACCURACY_COMPARE_H

#include <stdbool.h>
#include <stddef.h>

/* One answer: a scalar (rank 0) or a series. */
typedef struct accuracy_series {
    size_t rank, count;
    const double *at; /* the axis, which never falls; NULL if it is the index */
    const double *value;
    double zero; /* the value from which shares are counted, such as the oil's temperature */
} accuracy_series;

typedef struct accuracy_difference {
    double largest, rms; /* relative */
    double judged;       /* the one of them that the study judges */
} accuracy_difference;

double accuracy_largest_magnitude(const double *values, size_t count, double zero);
/* Scale of the relative error of a value, in a series whose largest magnitude is `most`. */
double accuracy_error_scale(double value, double most, size_t rank);
/* Errors `off` of an answer, each relative to its value: returns the typical one (estimate.h) and
   writes the largest. */
double accuracy_relative(const double *off, const accuracy_series *answer, double *largest);
double accuracy_interpolate(const accuracy_series *series, double x, bool right);
/* False if the two cannot be compared or their difference is not finite. */
bool accuracy_compare(const accuracy_series *answer, const accuracy_series *reference,
                      accuracy_difference *difference);

#endif
