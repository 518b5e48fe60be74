/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calls of ff_run_* that end the program if memory is short. */
#ifndef RUN_H
#define RUN_H

#include <flankfilm/engine.h>

/* The messages of each step are in ff_run_report(run). */
ff_run *run_read(ff_engine *engine, const char *file);
ff_run *run_copy(const ff_run *run);

/* Do nothing if the file could not be read. The places are as in ff_run_set_at. */
void run_set(ff_run *run, const char *assignment, const ff_place *path, const ff_place *value);
void run_set_all(ff_run *run, const char *const *assignments, size_t count);
void run_put(ff_run *run, const char *key, const ff_node *node);

/* Returns NULL only if no pipeline can be shown. A pipeline with errors in the report must not be
 * started. */
ff_pipeline *run_build(ff_run *run, bool everything);
bool run_has_errors(ff_run *run);

/* Returns the output that "stage.output" names, and its stage, which is also set if the output
 * is missing. NULL: there is no such output, or its model is not loaded. */
ff_result *run_output(const ff_pipeline *pipeline, const char *path, const ff_stage **stage);

/* Stage `i` of those that are evaluated together: the stages of a loop, or the stage alone. NULL
   after the last. */
ff_stage *run_together(const ff_pipeline *pipeline, const ff_stage *stage, size_t i);

/* False after an error, which the report contains, or if the observer stopped the run. */
bool run_start(ff_run *run, const ff_observer *watch);

#endif
