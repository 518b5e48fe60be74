/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors against costs, as numbers: the Pareto front. */
#ifndef STUDY_FRONT_H
#define STUDY_FRONT_H

#include <stdbool.h>
#include <stddef.h>

/* The points that no other beats in both: into `front`, by rising cost; their number. A point whose
   cost or error is not finite is on no front. */
size_t study_front(const double *cost, const double *error, size_t count, size_t *front);
/* The place on the front beyond which an error costs more than before: farthest from the line
   between its ends, in logarithms. `length` when there is none. */
size_t study_front_knee(const double *cost, const double *error, const size_t *front,
                        size_t length);
/* Cost over that of the cheapest point that is as good. */
double study_front_excess(const double *cost, const double *error, size_t count, size_t point);

#endif
