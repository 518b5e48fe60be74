/* SPDX-License-Identifier: MIT */
/* A pipeline from its file to its results. */
#ifndef FE_PIPELINE_H
#define FE_PIPELINE_H

#include "../value/tree.h"

/* Reads the file's `format`, `title`, `pipeline` and `outputs`, loads the models that are needed
 * (all of them with `everything`, as `check` wants), binds parameters, wires stages, and calls
 * their `ready`. All errors of the file go to the report in one pass. NULL only if nothing can
 * be shown; if the report has errors, the pipeline must not be run. The tree and the engine
 * outlive the pipeline. */
ff_pipeline *fe_pipeline_build(const fe_tree *tree, ff_engine *engine, bool everything,
                               ff_report *report);

/* Does what ff_run_change does, with the tree that the pipeline was built from. */
bool fe_pipeline_change(ff_pipeline *pipeline, fe_tree *tree, const char *const *assignments,
                        size_t count, bool objects);

/* Runs what is needed; observer may be NULL. False if a stage failed: the report then says why,
 * and the results so far stay readable. */
bool fe_pipeline_run(ff_pipeline *pipeline, const ff_observer *observer, ff_report *report);

void fe_pipeline_free(ff_pipeline *pipeline);

#endif
