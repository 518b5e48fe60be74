/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The error of an answer from coarser answers to the same question. */
#ifndef ACCURACY_ESTIMATE_H
#define ACCURACY_ESTIMATE_H

#include <stdbool.h>
#include <stddef.h>

/* Answers at the points of one of them. All settings are one level coarser in `half`, two in
   `quarter`; in each of `refined` one setting is back at the level of `half`; in `twice` all are a
   level finer. A level halves a count and quadruples a tolerance. All but the answer may be NULL:
   there is none, and `twice` is not looked at where there are both coarser ones.
   Where `loose` is given the levels above are those of the counts alone; `middle` is half with the
   tolerances of quarter, which may be coarser than those of the answer. `loose` differs from
   `tight`, which has the tolerances of the answer, by tolerances that are a level coarser, or a
   level finer where `is_finer`. */
typedef struct accuracy_ladder {
    size_t count;
    const double *at;    /* where the numbers are, which never falls; NULL: the index */
    const double *scale; /* what the error of each is relative to; NULL: 1 */
    const double *answer, *half, *quarter, *twice;
    const double *const *refined;
    size_t refined_count;
    const double *middle, *tight, *loose;
    bool is_finer;
} accuracy_ladder;

/*
 * Writes the estimated error of each number of the answer into error[count], of which the
 * tolerances make *by_tolerances, what is typical of that, relative, and into shares[refined_count]
 * what part of the rest each setting has; they are 0 where that is not known, else their sum is 1.
 * Returns the order observed, log2 of the growth of the differences from level to level; NaN where
 * nothing differs or there are two levels alone. There must be `half` or `twice`.
 */
double accuracy_estimate(const accuracy_ladder *ladder, double *error, double *shares,
                         double *by_tolerances);

/* What the values stay below along 95 % of the length; of few or one, the largest. `at` rises and
   says where they are; NULL: the index does. */
double accuracy_typical(const double *values, const double *at, size_t count);

#endif
