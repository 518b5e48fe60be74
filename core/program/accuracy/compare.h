/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Difference of two answers at the points of the reference. All errors are measured this way. */
#ifndef ACCURACY_COMPARE_H
#define ACCURACY_COMPARE_H

#include <stdbool.h>
#include <stddef.h>

/* One answer: a scalar (rank 0) or a series. */
typedef struct accuracy_series {
    size_t rank, count;
    const double *at; /* the axis, which never falls; NULL if it is the index */
    const double *value;
    double zero_point; /* zero point of relative errors, such as the oil's temperature */
    bool absolute;     /* errors are in the unit of the values, not relative to them */
} accuracy_series;

typedef struct accuracy_difference {
    double typical, largest; /* errors of a series: at 95 of 100 points, and at the worst one */
    bool absolute; /* the errors are absolute, since the reference is 0 or is marked `absolute` */
} accuracy_difference;

/* Writes for each value the size to which its error is relative. */
void accuracy_error_scales(const accuracy_series *answer, double *scales);
/* From the relative errors `off` of an answer, returns the typical one (estimate.h) and writes the
 * largest. */
double accuracy_relative(const double *off, const accuracy_series *answer, double *largest);
double accuracy_interpolate(const accuracy_series *series, double x, bool right);
/* Value of an answer at point i of another. */
double accuracy_value_at(const accuracy_series *series, const accuracy_series *points, size_t i);
/* False if the two cannot be compared or their difference is not finite. */
bool accuracy_compare(const accuracy_series *answer, const accuracy_series *reference,
                      accuracy_difference *difference);

#endif
