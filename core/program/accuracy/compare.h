/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Difference of two answers at the points of the reference: the one measure of an error. */
#ifndef ACCURACY_COMPARE_H
#define ACCURACY_COMPARE_H

#include <stdbool.h>
#include <stddef.h>

/* One answer: a scalar (rank 0) or a series. */
typedef struct accuracy_series {
    size_t rank, count;
    const double *at; /* the axis, which never falls; NULL if it is the index */
    const double *value;
    double zero;   /* the value from which shares are counted, such as the oil's temperature */
    bool absolute; /* errors are in the unit of the values, not relative to them */
} accuracy_series;

typedef struct accuracy_difference {
    double typical, largest; /* along a series: at 95 of 100 points, and at the worst one */
    bool absolute; /* they are in the unit of the values, since the reference is 0 or says so */
} accuracy_difference;

/* Writes for each value the size over which its error is stated. */
void accuracy_error_scales(const accuracy_series *answer, double *scales);
/* Errors `off` of an answer, each relative to its value: returns the typical one (estimate.h) and
   writes the largest. */
double accuracy_relative(const double *off, const accuracy_series *answer, double *largest);
double accuracy_interpolate(const accuracy_series *series, double x, bool right);
/* Value of an answer at point i of another. */
double accuracy_value_at(const accuracy_series *series, const accuracy_series *points, size_t i);
/* False if the two cannot be compared or their difference is not finite. */
bool accuracy_compare(const accuracy_series *answer, const accuracy_series *reference,
                      accuracy_difference *difference);

#endif
