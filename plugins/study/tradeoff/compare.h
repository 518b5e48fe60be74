/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors against costs, as numbers: what a trade-off is made of. */
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
    double largest, rms; /* relative */
    double judged;       /* that of both which the study goes by */
    size_t where;        /* point of the reference with the largest */
} ff_difference;

double ff_largest(const double *values, size_t count); /* by size */
/* What an error at a value is relative to, in a series whose largest is `most`. */
double ff_scale(double value, double most, size_t rank);
double ff_interpolate(const ff_series *series, double x, bool right);
/* False: they cannot be compared, or not to a finite number. */
bool ff_compare(const ff_series *answer, const ff_series *reference, ff_difference *difference);

/* front.c. The points that no other beats in both: into `front`, by rising cost; their number. A
   point whose cost or error is not finite is on no front. */
size_t ff_front(const double *cost, const double *error, size_t count, size_t *front);
/* The place on the front beyond which an error costs more than before: farthest from the line
   between its ends, in logarithms. `length` when there is none. */
size_t ff_front_knee(const double *cost, const double *error, const size_t *front, size_t length);
/* Cost over that of the cheapest point that is as good. */
double ff_front_excess(const double *cost, const double *error, size_t count, size_t point);

#endif
