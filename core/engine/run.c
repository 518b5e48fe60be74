/* SPDX-License-Identifier: MIT */
/* Runs: one case of a pipeline from its file to its results. */
#include "plugin/engine.h"

#include <string.h>

struct ff_run {
    ff_engine *engine;
    fe_heap heap;
    ff_tree *tree;
    ff_report *report; /* of the call that is being made */
    ff_pipeline *pipeline;
    bool broken; /* it had no memory once, and can only be closed */
    bool started, failed;
};

/* The arguments of a call, and what it answers. */
typedef struct run_call {
    ff_run *run;
    const char *text;        /* a file, or the path of a result */
    const char *const *sets; /* NULL-terminated, or NULL */
    const ff_observer *observer;
    void (*work)(struct run_call *call);
} run_call;

static void work(void *ctx)
{
    run_call *call = ctx;
    ff_run *run = call->run;
    run->report = ff_report_new();
    call->work(call);
    fe_engine_say(run->engine, run->report);
}

static void forget(void *ctx)
{
    ff_run *run = ctx;
    ff_report_free(run->report);
    run->report = NULL;
}

/* Makes the call, with messages of its own. */
static ff_status handle(run_call *call)
{
    ff_run *run = call->run;
    if (run->broken)
        return fe_engine_lack(run->engine);
    run->broken = fe_engine_call(run->engine, &run->heap, work, call) != FF_OK;
    if (run->broken)
        return FF_NOMEM;
    ff_status status = fe_status_of(run->report);
    fe_protected(&run->heap, forget, run);
    return status;
}

/* What the program does with many cases. */
static void refuse_many(run_call *call, const ff_node *root)
{
    static const char *const keys[] = {"study", "accuracy"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        const ff_node *node = ff_node_get(root, keys[i]);
        if (node && !(node->kind == FF_SCALAR && !*node->text))
            ff_error(call->run->report, FF_FAULT_INPUT, node->place, "flankfilm run FILE does both",
                     "%s: the library runs one case, whose models are known", keys[i]);
    }
}

static void open(run_call *call)
{
    ff_run *run = call->run;
    run->tree = ff_tree_load(call->text, run->report);
    if (!ff_tree_root(run->tree))
        return;
    for (const char *const *set = call->sets; set && *set; set++)
        ff_tree_set(run->tree, *set, NULL, NULL, run->report);
    refuse_many(call, ff_tree_root(run->tree));
    if (ff_report_errors(run->report) > 0)
        return;
    run->pipeline = ff_pipeline_build(run->tree, run->engine, false, run->report);
    ff_engine_warn_displaced(run->engine, run->report);
}

static void make(void *ctx)
{
    run_call *call = ctx;
    call->run = fe_alloc(sizeof *call->run);
}

ff_status ff_run_open(ff_engine *engine, const char *file, const char *const *sets, ff_run **run)
{
    run_call call = {.text = file, .sets = sets, .work = open};
    if (!run)
        return FF_INVALID;
    *run = NULL;
    if (!engine || !file)
        return FF_INVALID;
    if (fe_engine_call(engine, &engine->heap, make, &call) != FF_OK)
        return FF_NOMEM;
    call.run->engine = engine;
    ff_status status = handle(&call);
    if (status == FF_OK)
        *run = call.run;
    else
        ff_run_close(call.run);
    return status;
}

void ff_run_close(ff_run *run)
{
    if (!run)
        return;
    fe_heap_close(&run->heap);
    fe_free(run);
}

/* Members that the caller's struct is too short for are NULL. */
static void start(run_call *call)
{
    ff_observer observer = {.size = sizeof observer};
    if (call->observer)
        memcpy(&observer, call->observer,
               call->observer->size < sizeof observer ? call->observer->size : sizeof observer);
    ff_pipeline_run(call->run->pipeline, &observer, call->run->report);
}

ff_status ff_run_start(ff_run *run, const ff_observer *observer)
{
    run_call call = {.run = run, .observer = observer, .work = start};
    if (!run)
        return FF_INVALID;
    run->started = true;
    ff_status status = handle(&call);
    run->failed = status != FF_OK;
    for (size_t i = 0; !run->broken && i < run->pipeline->count; i++)
        if (run->pipeline->stages[i].status == FF_STOPPED && status != FF_OK)
            return FF_STOPPED;
    return status;
}

/* Whether the stage has results, which are whole. */
static bool is_done(const ff_stage *stage)
{
    return stage->ran || stage->reused;
}

/* The result of that path; NULL: it was not computed. */
static const ff_result *find(const ff_run *run, const char *path)
{
    const char *name;
    const ff_stage *stage = ff_stage_of(run->pipeline, path, &name);
    int output = stage && is_done(stage) ? ff_model_find_output(stage->loaded->model, name) : -1;
    return output >= 0 && stage->results[output].data ? &stage->results[output] : NULL;
}

static const char *why_not(const ff_run *run, const ff_stage *stage, const ff_result *result)
{
    if (!run->started)
        return "the run has not been started";
    if (result && result->refused)
        return "the model does not give it for these inputs";
    if (!result || !result->wanted)
        return "`outputs` of the file does not ask for it";
    return stage->status == FF_OK ? "what feeds its stage failed" : "its stage failed";
}

static void refuse_result(run_call *call)
{
    const ff_run *run = call->run;
    const char *name;
    const ff_stage *stage = ff_stage_of(run->pipeline, call->text, &name);
    const ff_model *model = stage && stage->loaded ? stage->loaded->model : NULL;
    int output = model ? ff_model_find_output(model, name) : -1;
    if (!stage || (model && (output < 0 || ff_model_output(model, (size_t)output)->service)))
        ff_error(run->report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "there is no result \"%.80s\"",
                 call->text);
    else
        ff_error(run->report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "%.80s was not computed: %s",
                 call->text, why_not(run, stage, output < 0 ? NULL : &stage->results[output]));
}

ff_status ff_run_result(ff_run *run, const char *path, const ff_result **result)
{
    if (!result)
        return FF_INVALID;
    *result = NULL;
    if (!run || !path)
        return FF_INVALID;
    *result = run->broken ? NULL : find(run, path);
    return *result ? FF_OK : handle(&(run_call){.run = run, .text = path, .work = refuse_result});
}

ff_status ff_run_output(const ff_run *run, size_t index, const char **stage,
                        const ff_result **result)
{
    if (!run || !stage || !result)
        return FF_INVALID;
    *stage = NULL;
    *result = NULL;
    for (size_t i = 0; !run->broken && i < run->pipeline->count; i++) {
        const ff_stage *s = &run->pipeline->stages[run->pipeline->order[i]];
        for (size_t k = 0; is_done(s) && k < s->loaded->model->output_count; k++)
            if (s->results[k].data && index-- == 0) {
                *stage = s->name;
                *result = &s->results[k];
                return FF_OK;
            }
    }
    return run->broken ? FF_NOMEM : FF_INVALID;
}

ff_status ff_run_quality(const ff_run *run, size_t index, const ff_quality **line)
{
    if (!run || !line)
        return FF_INVALID;
    *line = NULL;
    for (size_t i = 0; !run->broken && i < run->pipeline->count; i++) {
        const ff_stage *stage = &run->pipeline->stages[run->pipeline->order[i]];
        if (index < stage->quality_count) {
            *line = &stage->quality[index];
            return FF_OK;
        }
        index -= stage->quality_count;
    }
    return FF_INVALID;
}

static void refuse_verdict(run_call *call)
{
    ff_error(call->run->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
             "there is no verdict: the run has not been started");
}

ff_status ff_run_verdict(const ff_run *run, int32_t *verdict)
{
    const ff_quality *line;
    if (!run || !verdict)
        return FF_INVALID;
    *verdict = run->started && !run->failed ? FF_GOOD : FF_BAD;
    if (run->broken || !run->started)
        return handle(&(run_call){.run = (ff_run *)(uintptr_t)run, .work = refuse_verdict});
    for (size_t i = 0; ff_run_quality(run, i, &line) == FF_OK; i++)
        *verdict = line->verdict > *verdict ? line->verdict : *verdict;
    return FF_OK;
}

const char *ff_stage_name(const ff_stage *stage)
{
    return stage ? stage->name : "";
}
