/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measured errors in words, and as the quality of the stages, which is the one bookkeeping. */
#ifndef ACCURACY_LINES_H
#define ACCURACY_LINES_H

#include "measure.h"

/* Adds a line for each error to the quality of its stage, in place of what the stages estimated:
   once for an answer, and not for an attempt that others take results from. */
void accuracy_tell(const accuracy_record *record, const ff_pipeline *answer);

/* "0.54 %", of an error that no twin tells "not known"; to be freed. */
char *accuracy_print_relative(const accuracy_error *error);
/* "at few points up to 3 %; film.cells 0.3 %, tooth.points 0.1 %; order 2.1", or less of it; to be
   freed. */
char *accuracy_describe(const accuracy_error *error);
/* The stage's output whose error the line of that name estimates, which is measured; NULL: it is
   another line. */
const ff_result *accuracy_estimated(const ff_stage *stage, const char *line);
/* The largest relative error in the lines of the stage on the output, or on one whose name its own
   begins with, in the same unit: "h_min" of "h_min_lowest". NaN: there is none. */
double accuracy_estimated_share(const ff_stage *stage, const ff_result *result);
/* Whether the stage does not know the error of the output: a line of it has no number. */
bool accuracy_is_unknown(const ff_stage *stage, const ff_result *result);
/* Whether the stage knows the output from below alone: that error is infinite. */
bool accuracy_is_least(const ff_stage *stage, const ff_result *result);
/* Whether an output may say what another one is off by: "h_min_error", in its unit and along its
   dimensions. */
bool accuracy_may_estimate(const ff_port *row, const ff_port *of);
/* Whether it may say so of an output that is asked for. */
bool accuracy_is_estimate(const ff_stage *stage, const ff_result *result);
/* What the stage estimates itself that an output is off by, number by number: such an output,
   beside lines of quality for the same. Without lines it is of the model, as the scatter of a
   formula. NULL: there is none. */
const ff_result *accuracy_estimate_of(const ff_stage *stage, const ff_result *result);

#endif
