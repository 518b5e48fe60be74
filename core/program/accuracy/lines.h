/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measured errors in words, and as the quality of the stages, which is the one bookkeeping. */
#ifndef ACCURACY_LINES_H
#define ACCURACY_LINES_H

#include "measure.h"

/* Adds a line for each error to the quality of its stage, in place of what the stages estimated. */
void accuracy_tell(const accuracy_record *record, const ff_pipeline *answer);

/* "0.54 %", of an error that no twin tells "not known"; to be freed. */
char *accuracy_print_relative(const accuracy_error *error);
/* "at few points up to 3 %; film.cells 0.3 %, tooth.points 0.1 %; order 2.1", or less of it; to be
   freed. */
char *accuracy_describe(const accuracy_error *error);
/* Whether a line of quality tells an error that was measured. */
bool accuracy_is_line(const ff_quality *line);
/* The stage's output whose error the line of that name estimates, which is measured; NULL: it is
   another line. */
const ff_result *accuracy_estimated(const ff_stage *stage, const char *line);

#endif
