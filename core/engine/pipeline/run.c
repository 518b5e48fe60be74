/* SPDX-License-Identifier: MIT */
/* Runs each needed stage once, and each loop round after round, in order. */
#include "build.h"

#include <stdlib.h>

static bool evaluate(const ff_pipeline *pipeline, ff_stage *stage, const ff_array *in,
                     ff_report *report)
{
    return fe_evaluate(pipeline, stage, in, report) && fe_save_state(pipeline, stage, report);
}

/* Evaluates the stage, or takes over the results of an earlier run. A stage that is needed for its
   service alone computes nothing. */
static bool obtain(const ff_pipeline *pipeline, ff_stage *stage, const ff_array *in,
                   ff_report *report)
{
    const ff_observer *watch = stage->instance->watch;
    fe_forget_results(stage);
    if (!fe_wants_any(stage))
        return true;
    if (pipeline->chained && ff_stage_has_state(stage)) /* the result depends on the chain so far */
        return (stage->ran = evaluate(pipeline, stage, in, report));
    if (watch && watch->recall && watch->recall(watch->ctx, pipeline, stage)) {
        stage->reused = true;
        return fe_check_results(stage, report);
    }
    stage->ran = evaluate(pipeline, stage, in, report);
    if (watch && watch->keep)
        watch->keep(watch->ctx, pipeline, stage);
    return stage->ran;
}

static bool run_stage(ff_pipeline *pipeline, ff_stage *stage, ff_report *report)
{
    if (!stage->instance->alive || (stage->choice && !fe_choose(pipeline, stage, report)))
        return false;
    ff_array *in = fe_alloc(stage->loaded->model->input_count * sizeof *in);
    bool good = fe_gather_inputs(pipeline, stage, in, report);
    if (good) {
        stage->ran = obtain(pipeline, stage, in, report);
        good = fe_check_quality(stage, report) && stage->ran;
        if (good && stage->choice && stage->choice->chosen) /* a bad result keeps no promise */
            fe_note_choice(stage);
    }
    fe_free(in);
    return good;
}

/* Where one stage of the loop feeds a choice, all do. */
static void mark_loop(const ff_pipeline *pipeline, const ff_loop *loop, bool *feeds)
{
    bool any = false;
    for (size_t i = 0; i < loop->count; i++)
        any = any || feeds[pipeline->order[loop->first + i]];
    for (size_t i = 0; i < loop->count; i++)
        feeds[pipeline->order[loop->first + i]] = any;
}

/* True for each stage that feeds a choice, directly or through others. */
static bool *mark_feeding(const ff_pipeline *pipeline)
{
    bool *feeds = fe_alloc(pipeline->count * sizeof *feeds);
    for (size_t i = pipeline->count; i-- > 0;) {
        size_t at = pipeline->order[i];
        const ff_stage *stage = &pipeline->stages[at];
        if (stage->loop)
            mark_loop(pipeline, stage->loop, feeds);
        for (size_t k = 0; stage->needed && k < stage->wire_count; k++)
            if (stage->wires[k].stage >= 0 &&
                (stage->choice || feeds[at] || fe_is_judge(pipeline, stage)))
                feeds[stage->wires[k].stage] = true;
    }
    return feeds;
}

static void begin_run(ff_pipeline *pipeline)
{
    fe_folder_keep(&pipeline->memory->folder);
    for (size_t i = 0; i < pipeline->count; i++) {
        pipeline->stages[i].ran = pipeline->stages[i].reused = false;
        pipeline->stages[i].status = FF_OK;
        pipeline->stages[i].seconds = pipeline->stages[i].work = 0;
    }
}

/* Runs the stages that `feeds` marks, and makes the choices; NULL: runs all stages. */
static bool run(ff_pipeline *pipeline, const bool *feeds, const ff_observer *watch,
                ff_report *report)
{
    bool good = true, judged = false, lawful = true;
    begin_run(pipeline);
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[pipeline->order[i]];
        bool whole = !feeds || feeds[pipeline->order[i]];
        bool judge = stage->needed && fe_is_judge(pipeline, stage);
        if (judge && !judged)
            good = (lawful = fe_choose_laws(pipeline, report)) && good;
        judged = judged || judge;
        if (!stage->needed || !(whole || stage->choice) || (judge && !lawful))
            continue;
        if (stage->loop) {
            good = fe_run_loop(pipeline, stage->loop, watch, report) && good;
            i += stage->loop->count - 1;
            if (stage->status == FF_STOPPED)
                return false;
            continue;
        }
        fe_instance *instance = stage->instance; /* making a choice replaces it */
        instance->watch = watch;
        good = (whole ? run_stage(pipeline, stage, report)
                      : instance->alive && fe_choose(pipeline, stage, report)) &&
               good;
        instance->watch = stage->instance->watch = NULL;
        if (stage->status == FF_STOPPED)
            return false;
    }
    return judged ? good : fe_choose_laws(pipeline, report) && good;
}

bool ff_pipeline_run(ff_pipeline *pipeline, const ff_observer *watch, ff_report *report)
{
    return run(pipeline, NULL, watch, report);
}

bool ff_pipeline_choose(ff_pipeline *pipeline, const ff_observer *watch, ff_report *report)
{
    bool *feeds = mark_feeding(pipeline);
    bool good = run(pipeline, feeds, watch, report);
    fe_free(feeds);
    return good;
}
