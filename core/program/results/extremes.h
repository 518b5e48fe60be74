/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the least and the greatest number of a result. */
#ifndef RESULTS_EXTREMES_H
#define RESULTS_EXTREMES_H

#include <flankfilm/engine.h>

/* Indices of the least and the greatest number of a result. */
typedef struct results_extremes {
    size_t least, greatest;
    bool partial; /* true if shares were left out because their whole is almost 0 */
} results_extremes;

/* Finds both among the known numbers; false if none is known. If the result is a share of another
 * series, which its row names as `origin`, only points count where that series is at least 1 % of
 * its largest value: a friction coefficient counts only where there is load. */
bool results_find_extremes(const ff_pipeline *pipeline, const ff_stage *stage,
                           const ff_result *result, results_extremes *out);

/* Returns the stage whose result this is; NULL if there is none. */
const ff_stage *results_stage_of(const ff_pipeline *pipeline, const ff_result *result);

#endif
