/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calls of ff_run_* that end the program if memory is short. */
#ifndef RUN_H
#define RUN_H

#include <flankfilm/engine.h>

/* Messages of each step are in ff_run_report(run). */
ff_run *run_read(ff_engine *engine, const char *file);
ff_run *run_copy(const ff_run *run);

/* Nothing where the file could not be read. The places are those of ff_run_set_at. */
void run_set(ff_run *run, const char *assignment, const ff_place *path, const ff_place *value);
void run_set_all(ff_run *run, const char *const *assignments, size_t count);
void run_put(ff_run *run, const char *key, const ff_node *node);

/* NULL only when nothing can be shown; with errors in the report it must not be started. */
ff_pipeline *run_build(ff_run *run, bool everything);
bool run_has_errors(ff_run *run);

/* Returns what "stage.output" names, and its stage, which may be there without the output; NULL
   where there is none, or its model is not loaded. */
ff_result *run_output(const ff_pipeline *pipeline, const char *path, const ff_stage **stage);

/* False after an error, which the report says, and where the observer stopped the run. */
bool run_start(ff_run *run, const ff_observer *watch);

#endif
