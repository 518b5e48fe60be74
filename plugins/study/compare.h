/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far one answer is from another, for the studies of this folder: relative, at the points of
   the reference. */
#ifndef FF_COMPARE_H
#define FF_COMPARE_H

#include <stdbool.h>
#include <stddef.h>

/* An answer: a scalar (rank 0) or a series. */
typedef struct ff_series {
    size_t rank, count;
    const double *at; /* what it is plotted against, not falling; NULL: its index */
    const double *value;
} ff_series;

typedef struct ff_difference {
    double largest, rms, mean; /* relative */
    double judged;             /* that of them which the study goes by */
    size_t where;              /* point of the reference with the largest */
} ff_difference;

double ff_largest(const double *values, size_t count); /* by size */
/* What an error at a value is relative to, in a series whose largest is `most`. */
double ff_scale(double value, double most, size_t rank);
double ff_interpolate(const ff_series *series, double x, bool right);
/* False: they cannot be compared, or not to a finite number. */
bool ff_compare(const ff_series *answer, const ff_series *reference, ff_difference *difference);
/* Half the difference of two answers on both sides of `middle`, on the mean. *bent: the sides by
   themselves are so different that no straight line holds. False: it cannot be told. */
bool ff_slope(const ff_series *middle, const ff_series *up, const ff_series *down, double *slope,
              bool *bent);

#endif
