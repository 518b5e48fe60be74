/* SPDX-License-Identifier: MIT */
/* Runs each needed stage once, in order, for the outputs that other stages and the user want. */
#include "build.h"

#include <stdlib.h>
#include <time.h>

static bool check_quality(const ff_stage *stage, ff_report *report)
{
    bool good = true;
    for (size_t i = 0; i < stage->quality_count; i++) {
        const ff_quality *line = &stage->quality[i];
        if (line->verdict == FF_BAD)
            good = ff_error(report, FF_FAULT_RUN, stage->place, NULL,
                            "%s: its result cannot be trusted: %s is %.3g, held to %.3g%s%s",
                            stage->name, line->name, line->value, line->limit,
                            line->text ? ": " : "", line->text ? line->text : "");
    }
    return good;
}

static double seconds_of(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/*
 * A model may refuse an output that its inputs do not allow. It is dropped when it was not
 * requested by name (but as one of "film.*") and no required input needs it. True when it was
 * dropped.
 */
static bool drop_refused(ff_stage *stage)
{
    const fe_instance *instance = stage->instance;
    int output = ff_model_find_output(stage->loaded->model, instance->item);
    if (stage->status != FF_UNSUPPORTED || instance->fault[0] || output < 0 ||
        !stage->results[output].wanted || stage->results[output].required)
        return false;
    stage->results[output].wanted = stage->results[output].requested = false;
    return true;
}

/* False after an error. */
static bool evaluate(const ff_pipeline *pipeline, ff_stage *stage, const ff_array *in,
                     ff_report *report)
{
    fe_instance *instance = stage->instance;
    bool good, again;
    do {
        fe_forget_results(stage);
        stage->status = FF_OK;
        if (!fe_wants_any(stage))
            return true;
        if (!fe_restore_state(pipeline, stage, report))
            return false;
        fe_call call = fe_call_begin(stage, "evaluate");
        instance->evaluating = true;
        double start = seconds_of(CLOCK_MONOTONIC), work = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
        stage->status = stage->loaded->model->evaluate(instance->self, fe_wanted_of(stage), in);
        stage->work += seconds_of(CLOCK_PROCESS_CPUTIME_ID) - work;
        stage->seconds += seconds_of(CLOCK_MONOTONIC) - start;
        instance->evaluating = false;
        again = drop_refused(stage);
        good = fe_call_end(&call, again ? FF_OK : stage->status, report);
    } while (again);
    return good && fe_check_results(stage, report) && fe_save_state(pipeline, stage, report);
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
        good = check_quality(stage, report) && stage->ran;
        if (good && stage->choice && stage->choice->chosen) /* a bad result keeps no promise */
            fe_note_choice(stage);
    }
    fe_free(in);
    return good;
}

/* True for each stage that feeds a choice, directly or through others. */
static bool *mark_feeding(const ff_pipeline *pipeline)
{
    bool *feeds = fe_alloc(pipeline->count * sizeof *feeds);
    for (size_t i = pipeline->count; i-- > 0;) {
        size_t at = pipeline->order[i];
        const ff_stage *stage = &pipeline->stages[at];
        for (size_t k = 0; stage->needed && k < stage->wire_count; k++)
            if (stage->wires[k].stage >= 0 &&
                (stage->choice || feeds[at] || fe_is_judge(pipeline, stage)))
                feeds[stage->wires[k].stage] = true;
    }
    return feeds;
}

static void begin_run(ff_pipeline *pipeline)
{
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
