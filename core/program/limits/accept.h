/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Checks the keys of `accept: {film.lambda: "run-in flanks, measured"}` against the existing
 * quality lines. A key without such a line may be misspelt, and causes a warning.
 */
#ifndef LIMITS_ACCEPT_H
#define LIMITS_ACCEPT_H

#include "../accuracy/measure.h"

#include <jansson.h>

/* Checks the keys for a run. Stages that did not run are ignored. */
void accept_check_pipeline(const ff_pipeline *pipeline, ff_report *report);
/* Checks the keys for the cases of a study. `lines` is {"STAGE.LINE": true}. */
void accept_check_lines(const ff_node *accept, json_t *lines, ff_report *report);

#endif
