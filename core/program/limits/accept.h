/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a file accepts, `accept: {film.lambda: "run-in flanks, measured"}`, against the lines that
 * there are: a doubt that no line has may be a wrong name, which is warned of.
 */
#ifndef LIMITS_ACCEPT_H
#define LIMITS_ACCEPT_H

#include "../accuracy/measure.h"

#include <jansson.h>

/* Of a run: stages that did not run are not looked at. */
void accept_check_pipeline(const ff_pipeline *pipeline, ff_report *report);
/* Of the cases of a study, whose lines are {"STAGE.LINE": true}. */
void accept_check_lines(const ff_node *accept, json_t *lines, ff_report *report);

#endif
