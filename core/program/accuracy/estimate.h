/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the error of an answer, the numbers of one output of a run, from runs with coarser
   settings. */
#ifndef ACCURACY_ESTIMATE_H
#define ACCURACY_ESTIMATE_H

#include <stdbool.h>
#include <stddef.h>

/* The numbers of one output at the same points, from runs with different settings. In `half` all
   settings are one level coarser than in the answer, in `quarter` two; in each of `refined` one
   setting is back at the level of `half`; in `twice` all are one level finer. One level halves a
   count and quadruples a tolerance. All but the answer may be NULL; `twice` is ignored if both
   coarser values exist. */
typedef struct accuracy_ladder {
    size_t count;
    const double *at;    /* the axis, which never falls; NULL if it is the index */
    const double *scale; /* scale of each number's relative error; NULL if it is 1 */
    const double *answer, *half, *quarter, *twice;
    const double *const *refined;
    size_t refined_count;
} accuracy_ladder;

/*
 * Writes error[count], the estimated error of each number of the answer, and shares[refined_count],
 * the part that each setting causes: their sum is 1, or they are all 0 if it is not known. Returns
 * the observed order, log2 of the growth of the differences; NaN if nothing differs or there are
 * only two levels. One of `half`, `quarter` and `twice` must be given.
 */
double accuracy_estimate(const accuracy_ladder *ladder, double *error, double *shares);

/* Typical value: the level that 95 % of the axis' length stays below; for few values or one, the
   largest. `at` is the rising axis; NULL if it is the index. */
double accuracy_typical(const double *values, const double *at, size_t count);

#endif
