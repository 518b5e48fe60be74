/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a case gave for an output, and how far one answer is from another. */
#ifndef FF_AUDIT_COMPARE_H
#define FF_AUDIT_COMPARE_H

#include <stdbool.h>
#include <stddef.h>

/* A scalar, or a series over points of its own. */
typedef struct ff_answer {
    bool series;
    size_t count;
    double *at; /* what a series is plotted against, not falling; NULL: its index */
    double *value;
} ff_answer;

/* Relative, at the points of the reference. Where a series is small, a tenth of its largest value
   takes the place of its value. */
typedef struct ff_distance {
    double mean, largest;
} ff_distance;

void ff_answer_free(ff_answer *answer);
/* False: they cannot be compared, or not to a finite number. */
bool ff_answer_compare(const ff_answer *answer, const ff_answer *reference, ff_distance *distance);
/* By half the difference of two answers on both sides of `middle`, on the mean. *bent: the sides
   by themselves are so different that no straight line holds. False: it cannot be told. */
bool ff_answer_slope(const ff_answer *middle, const ff_answer *up, const ff_answer *down,
                     double *slope, bool *bent);

#endif
