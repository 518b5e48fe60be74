/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The least and the greatest number of a result, with the stage that it comes from. */
#ifndef RESULTS_EXTREMES_H
#define RESULTS_EXTREMES_H

#include <flankfilm/engine.h>

/* Ranks of the least and the greatest number of a result. */
typedef struct results_extremes {
    size_t least, greatest;
    bool partial; /* numbers were left out: those of a share where its whole is next to nothing */
} results_extremes;

/*
 * Finds them among the numbers that are known; false if none is. A series that is a share of
 * another, which `origin` of its row names, counts where that is at least a hundredth of its
 * largest: friction where there is load.
 */
bool results_find_extremes(const ff_pipeline *pipeline, const ff_stage *stage,
                           const ff_result *result, results_extremes *out);

/* The stage that has given a result; NULL: none. */
const ff_stage *results_stage_of(const ff_pipeline *pipeline, const ff_result *result);

#endif
