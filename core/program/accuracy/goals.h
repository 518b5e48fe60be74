/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a file asks of its errors: `accuracy: measured`, or how large each may be, for all outputs
 * or one by one: `accuracy: 2 %`, `accuracy: {film.h_min: 2 %, motion.dte_rms: 1 %}`.
 */
#ifndef ACCURACY_GOALS_H
#define ACCURACY_GOALS_H

#include <flankfilm/engine.h>

/* Whether the file asks for errors. */
bool accuracy_is_asked(const ff_run *run);
/* Whether it says how large one of them may be. */
bool accuracy_has_goals(const ff_run *run);
/* Whether a scalar or a series is asked for: other outputs have no error that is measured. */
bool accuracy_has_outputs(const ff_pipeline *pipeline);
/* How large, relative, the error of an output may be; NaN: the file does not say. */
double accuracy_goal(const ff_run *run, const ff_stage *stage, const ff_result *result);
/* Where the file asks; FF_NOWHERE: it does not. */
ff_place accuracy_place(const ff_run *run);
/* "film.h_min: 2 %", for the key of a case; to be freed. */
char *accuracy_print_goals(const ff_run *run);

/* Reports what is wrong with what the file asks of the pipeline that was built from it. */
bool accuracy_check(ff_run *run);

#endif
