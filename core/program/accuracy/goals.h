/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The errors that a file asks for: `accuracy: measured`, one goal for all outputs as in `accuracy:
 * 2 %`, or one goal each as in `accuracy: {film.h_min: 2 %, scuffing.flash_temperature: 0.5 K}`.
 * Two keys are not outputs: `all: 2 %` is the goal of all other outputs, and `check: twins`
 * compares the answer with a finer twin.
 */
#ifndef ACCURACY_GOALS_H
#define ACCURACY_GOALS_H

#include <flankfilm/engine.h>

/* True if the file asks for errors. */
bool accuracy_is_requested(const ff_run *run);
/* True if the file says `check: twins`: the answer is compared with a finer twin. */
bool accuracy_has_check(const ff_run *run);
/* True if the file states a goal. */
bool accuracy_has_goals(const ff_run *run);
/* True if a scalar or a series is requested; the errors of other outputs cannot be measured. */
bool accuracy_has_outputs(const ff_pipeline *pipeline);
/* Goal for the error of an output, in SI if it is absolute; NaN if the file states none. */
double accuracy_goal(const ff_run *run, const ff_stage *stage, const ff_result *result,
                     bool *absolute);
/* Place of the request in the file; FF_NOWHERE if there is none. */
ff_place accuracy_place(const ff_run *run);
/* Prints the goals, such as "film.h_min: 2 %", for the key of a case; to be freed. */
char *accuracy_print_goals(const ff_run *run);

/* Reports faults in the accuracy request of the pipeline that was built from the file. */
bool accuracy_check(ff_run *run);

#endif
