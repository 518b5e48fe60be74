/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Pareto front of errors and costs. */
#ifndef STUDY_FRONT_H
#define STUDY_FRONT_H

#include <stdbool.h>
#include <stddef.h>

/* Lists in `front`, by rising cost, the points for which no other has both a lower cost and a
 * smaller error, and returns their number. Points with a cost or error that is not finite are left
 * out. */
size_t study_front(const double *cost, const double *error, size_t count, size_t *front);
/* Returns the index of the knee of the front, beyond which a smaller error becomes more expensive:
 * the point farthest from the line between its ends, in logarithms. `length` if there is none. */
size_t study_front_knee(const double *cost, const double *error, const size_t *front,
                        size_t length);
/* Returns the cost of a point relative to the cheapest point with the same or a smaller error. */
double study_front_excess(const double *cost, const double *error, size_t count, size_t point);

#endif
