/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints measured errors and enters them as quality lines of the stages. */
#ifndef ACCURACY_LINES_H
#define ACCURACY_LINES_H

#include "measure.h"

/* Adds a quality line for each measured error to its stage and removes the stage's own estimate.
   For the final answer only, not for attempts whose results others reuse. */
void accuracy_add_lines(const accuracy_record *record, const ff_pipeline *answer);

/* Prints the measured error in the form of its goal, "0.54 %" or "0.31 K", or "not known" if no
   twin could determine it. The text must be freed. */
char *accuracy_print_reached(const accuracy_error *error);
/* Prints the goal, or "" if there is none. The text must be freed. */
char *accuracy_print_goal(const accuracy_error *error);
/* Prints "at few points up to 3 %; film.cells 0.3 %, tooth.points 0.1 %; order 2.1", or those
   parts of this text that apply. The text must be freed. */
char *accuracy_describe(const accuracy_error *error);
/* Prints how far the answer is from a finer twin, or why this distance is not known. The text must
   be freed. */
char *accuracy_print_check(const accuracy_record *record, const accuracy_error *error);
/* Largest relative error that the stage's lines state for the output, or for an output in the same
   unit whose name begins the output's name, such as "h_min" for "h_min_lowest". NaN if there is
   none. */
double accuracy_estimated_share(const ff_stage *stage, const ff_result *result);
/* Fills in what the stage estimates the error of each number of the output to be, in SI; infinite
 * if it is not known. False if the stage does not estimate it. */
bool accuracy_fill_estimates(const ff_stage *stage, const ff_result *result, double *errors);
/* True if a line of the stage says that the output's error is not known. */
bool accuracy_is_unknown(const ff_stage *stage, const ff_result *result);
/* True if the stage knows only a lower bound of the output, which it states by an infinite error.
 */
bool accuracy_is_least(const ff_stage *stage, const ff_result *result);
/* True if the row may be an error estimate of `of`, such as "h_min_error" for "h_min": both must
 * have the same unit and dimensions. */
bool accuracy_may_estimate(const ff_port *row, const ff_port *of);
/* True if the result is an error estimate of a requested output. */
bool accuracy_is_estimate(const ff_stage *stage, const ff_result *result);
/* Returns the output in which the stage itself estimates the error of the given output, number by
   number; NULL if there is none. Such an estimate counts only if the stage also has a quality line
   for the error. Otherwise it is an error of the model, such as the scatter of a formula. */
const ff_result *accuracy_estimate_of(const ff_stage *stage, const ff_result *result);

#endif
