/* SPDX-License-Identifier: MIT */
/* Runs the needed stages in order: a stage once, a loop in rounds. */
#include "../plugin/engine.h"
#include "build.h"
#include "pipeline.h"

#include <stdlib.h>

static bool evaluate(const ff_pipeline *pipeline, ff_stage *stage, const ff_array *in,
                     ff_report *report)
{
    return fe_evaluate(pipeline, stage, in, report) && fe_save_state(pipeline, stage, report);
}

/* Evaluates the stage, or reuses the results of an earlier run. A stage that is needed only for its
   service computes nothing. */
static bool obtain(const ff_pipeline *pipeline, ff_stage *stage, const ff_array *in,
                   ff_report *report)
{
    const ff_observer *watch = stage->instance->watch;
    fe_forget_results(stage);
    if (!fe_wants_any(stage))
        return true;
    if (pipeline->chained &&
        ff_stage_has_state(stage)) /* its result depends on the earlier cases of the chain */
        return (stage->ran = evaluate(pipeline, stage, in, report));
    if (watch && watch->recall && watch->recall(watch->ctx, pipeline, stage)) {
        stage->reused = true;
        return fe_check_results(stage, NULL, report);
    }
    stage->ran = evaluate(pipeline, stage, in, report);
    if (watch && watch->keep)
        watch->keep(watch->ctx, pipeline, stage);
    return stage->ran;
}

static bool run_stage(ff_pipeline *pipeline, ff_stage *stage, ff_report *report)
{
    if (!stage->instance->alive)
        return false;
    ff_array *in = fe_alloc(stage->loaded->model->input_count * sizeof *in);
    bool good = fe_gather_inputs(pipeline, stage, in, report);
    if (good) {
        stage->ran = obtain(pipeline, stage, in, report);
        good = fe_check_quality(stage, report) && stage->ran;
    }
    fe_free(in);
    return good;
}

static void begin_run(ff_pipeline *pipeline)
{
    fe_folder_keep(&pipeline->memory->folder);
    for (size_t i = 0; i < pipeline->count; i++) {
        pipeline->stages[i].ran = pipeline->stages[i].reused = false;
        pipeline->stages[i].status = FF_OK;
        pipeline->stages[i].instance->left = false;
        pipeline->stages[i].seconds = pipeline->stages[i].work = 0;
    }
}

/* Reports plugins whose file was overwritten in place, which changes their running code. Replacing
   the file by a new one, as `install` does, is harmless. */
static bool check_files(const ff_pipeline *pipeline, ff_report *report)
{
    static const char what[] = "was overwritten while it was in use, so the results may come from "
                               "neither build; run the command again";
    bool good = true;
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        if (stage->needed && fe_is_written_over(stage->loaded))
            good = fe_plugin_fault(stage, report, what);
    }
    return good;
}

bool fe_pipeline_run(ff_pipeline *pipeline, const ff_observer *watch, ff_report *report)
{
    bool good = true;
    begin_run(pipeline);
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[pipeline->order[i]];
        if (!stage->needed)
            continue;
        if (stage->loop) {
            good = fe_run_loop(pipeline, stage->loop, watch, report) && good;
            i += stage->loop->count - 1;
        } else {
            stage->instance->watch = watch;
            good = run_stage(pipeline, stage, report) && good;
            stage->instance->watch = NULL;
        }
        if (stage->status == FF_STOPPED && !stage->instance->left)
            return false;
    }
    fe_compare_quantities(pipeline);
    return check_files(pipeline, report) && good;
}
