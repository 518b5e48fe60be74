/* SPDX-License-Identifier: MIT */
/* Builds a pipeline from its file, changes it and runs it. */
#ifndef FE_PIPELINE_H
#define FE_PIPELINE_H

#include "../value/tree.h"

/* Reads `format`, `title`, `pipeline` and `outputs` of the file, loads the needed models (with
   `everything` all of them, as `check` does), binds parameters, wires stages, and calls their
   `ready`. Reports all errors of the file in one pass. Returns NULL only if nothing can be shown.
   If the report has errors, the pipeline must not be run. The tree and the engine must outlive the
   pipeline. */
ff_pipeline *fe_pipeline_build(const fe_tree *tree, ff_engine *engine, bool everything,
                               ff_report *report);

/* Implements ff_run_change; `tree` is the tree from which the pipeline was built. */
bool fe_pipeline_change(ff_pipeline *pipeline, fe_tree *tree, const char *const *assignments,
                        size_t count, bool objects);

/* Runs the needed stages; observer may be NULL. False if a stage failed: the report then has the
   reason, and the results so far remain readable. */
bool fe_pipeline_run(ff_pipeline *pipeline, const ff_observer *observer, ff_report *report);

void fe_pipeline_free(ff_pipeline *pipeline);

#endif
