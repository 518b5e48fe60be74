/* SPDX-License-Identifier: MIT */
/* A run is one case of a pipeline: its file, its settings, its evaluation. */
#include "run.h"

#include <string.h>

static void work(void *ctx)
{
    fe_run_request *call = ctx;
    ff_run *run = call->run;
    if (!run->report)
        run->report = ff_report_new();
    run->call_report = ff_report_new();
    call->work(call);
    fe_engine_set_message(run->engine, run->call_report);
    if (call->step)
        ff_report_append(run->report, run->call_report);
}

static void forget(void *ctx)
{
    ff_run *run = ctx;
    ff_report_free(run->call_report);
    run->call_report = NULL;
}

ff_status fe_run_call(fe_run_request *call)
{
    ff_run *run = call->run;
    if (run->broken)
        return fe_engine_lack(run->engine);
    run->broken = fe_engine_call(run->engine, &run->heap, work, call) != FF_OK;
    if (run->broken)
        return FF_NOMEM;
    ff_status status = fe_status_of(run->call_report);
    fe_protected(&run->heap, forget, run);
    return status;
}

static void make(void *ctx)
{
    fe_run_request *call = ctx;
    call->run = fe_alloc(sizeof *call->run);
}

/* Creates a run and takes its first step, such as reading the file. */
static ff_status begin(ff_engine *engine, fe_run_request *call, ff_run **run)
{
    if (fe_engine_call(engine, &engine->heap, make, call) != FF_OK)
        return FF_NOMEM;
    call->run->engine = engine;
    call->step = true;
    ff_status status = fe_run_call(call);
    *run = call->run;
    if (call->run->broken) {
        *run = NULL;
        ff_run_close(call->run);
    }
    return status;
}

static void read(fe_run_request *call)
{
    call->run->tree = fe_tree_load(call->text, call->run->call_report);
}

ff_status ff_run_read(ff_engine *engine, const char *file, ff_run **run)
{
    if (!run)
        return FF_INVALID;
    *run = NULL;
    if (!engine || !file)
        return FF_INVALID;
    return begin(engine, &(fe_run_request){.work = read, .text = file}, run);
}

static void parse(fe_run_request *call)
{
    call->run->tree =
        fe_tree_parse(call->name, call->directory, call->text, call->run->call_report);
}

ff_status ff_run_parse(ff_engine *engine, const char *name, const char *directory, const char *text,
                       ff_run **run)
{
    fe_run_request call = {.work = parse, .text = text, .name = name, .directory = directory};
    if (!run)
        return FF_INVALID;
    *run = NULL;
    if (!engine || !name || !directory || !text)
        return FF_INVALID;
    return begin(engine, &call, run);
}

static void copy(fe_run_request *call)
{
    call->run->tree = fe_tree_copy(call->from->tree);
}

ff_status ff_run_copy(const ff_run *run, ff_run **copied)
{
    if (!copied)
        return FF_INVALID;
    *copied = NULL;
    if (!run || !ff_run_root(run))
        return FF_INVALID;
    return begin(run->engine, &(fe_run_request){.work = copy, .from = run}, copied);
}

/* Whether settings may still be applied to the file of the run. */
static bool is_open(const ff_run *run)
{
    return run && ff_run_root(run) && !run->pipeline;
}

static void set(fe_run_request *call)
{
    fe_tree_set(call->run->tree, call->text, call->path, call->value, call->run->call_report);
}

ff_status ff_run_set_at(ff_run *run, const char *assignment, const ff_place *path,
                        const ff_place *value)
{
    fe_run_request call = {
        .run = run, .work = set, .step = true, .text = assignment, .path = path, .value = value};
    return is_open(run) && assignment ? fe_run_call(&call) : FF_INVALID;
}

ff_status ff_run_set(ff_run *run, const char *assignment)
{
    return ff_run_set_at(run, assignment, NULL, NULL);
}

static void put(fe_run_request *call)
{
    fe_tree_put(call->run->tree, call->text, call->node);
}

ff_status ff_run_put(ff_run *run, const char *key, const ff_node *node)
{
    fe_run_request call = {.run = run, .work = put, .step = true, .text = key, .node = node};
    return is_open(run) && key && node ? fe_run_call(&call) : FF_INVALID;
}

/* Builds the pipeline. Also reports the errors of earlier steps again, since a file with an error
   cannot be started. */
static void build(fe_run_request *call)
{
    ff_run *run = call->run;
    ff_report_append(run->call_report, run->report);
    run->pipeline = fe_pipeline_build(run->tree, run->engine, call->all, run->call_report);
    run->ready = run->pipeline && ff_report_errors(run->call_report) == 0;
}

ff_status ff_run_build(ff_run *run, bool everything)
{
    fe_run_request call = {.run = run, .work = build, .step = true, .all = everything};
    return is_open(run) ? fe_run_call(&call) : FF_INVALID;
}

/* Refuses a file that needs many cases, which only the program runs. Returns false in this case. */
static bool refuse_many(const ff_node *root, ff_report *report)
{
    static const char *const keys[] = {"study", "accuracy"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        const ff_node *node = ff_node_get(root, keys[i]);
        if (node && !(node->kind == FF_SCALAR && !*node->text))
            ff_error(
                report, FF_FAULT_INPUT, node->place, "run it with the program: flankfilm run FILE",
                "%s: the library runs a single case, with models that the file names", keys[i]);
    }
    return ff_report_errors(report) == 0;
}

static void prepare(fe_run_request *call)
{
    if (!refuse_many(fe_tree_root(call->run->tree), call->run->call_report))
        return;
    build(call);
    ff_engine_warn_displaced(call->run->engine, call->run->call_report);
}

ff_status ff_run_ready(ff_run *run)
{
    fe_run_request call = {.run = run, .work = prepare, .step = true};
    if (run && run->ready)
        return FF_OK;
    return is_open(run) ? fe_run_call(&call) : FF_INVALID;
}

ff_status ff_run_open(ff_engine *engine, const char *file, const char *const *sets, ff_run **run)
{
    ff_status status = ff_run_read(engine, file, run);
    if (!run || !*run)
        return status;
    for (; sets && *sets && ff_run_root(*run); sets++)
        if (ff_run_set(*run, *sets) == FF_NOMEM)
            status = FF_NOMEM;
    if (ff_run_root(*run))
        status = ff_run_ready(*run);
    if (status != FF_OK) {
        ff_run_close(*run);
        *run = NULL;
    }
    return status;
}

static void change(fe_run_request *call)
{
    ff_run *run = call->run;
    call->done =
        fe_pipeline_change(run->pipeline, run->tree, call->changes, call->count, call->all);
}

ff_status ff_run_change(ff_run *run, const char *const *assignments, size_t count, bool objects)
{
    fe_run_request call = {
        .run = run, .work = change, .changes = assignments, .count = count, .all = objects};
    if (!run || !run->ready || (count && !assignments))
        return FF_INVALID;
    ff_status status = fe_run_call(&call);
    run->ready = run->ready && call.done;
    return status == FF_OK && !call.done ? FF_UNSUPPORTED : status;
}

static void end(void *ctx)
{
    ff_run *run = ctx;
    fe_pipeline_free(run->pipeline);
    fe_tree_free(run->tree);
}

void ff_run_close(ff_run *run)
{
    if (!run)
        return;
    if (!run->broken)
        fe_protected(&run->heap, end, run);
    /* The caller's messages lie in memory that the run does not own. */
    ff_report_free(run->report);
    fe_heap_close(&run->heap);
    fe_free(run);
}

/* Copies the observer. Members beyond the size of the caller's struct are NULL. */
static void start(fe_run_request *call)
{
    ff_observer observer = {.size = sizeof observer};
    if (call->observer)
        memcpy(&observer, call->observer,
               call->observer->size < sizeof observer ? call->observer->size : sizeof observer);
    fe_pipeline_run(call->run->pipeline, &observer, call->run->call_report);
}

ff_status ff_run_start(ff_run *run, const ff_observer *observer)
{
    fe_run_request call = {.run = run, .work = start, .step = true, .observer = observer};
    ff_status status = run ? ff_run_ready(run) : FF_INVALID;
    if (status != FF_OK)
        return status;
    run->started = true;
    status = fe_run_call(&call);
    run->failed = status != FF_OK;
    for (size_t i = 0; !run->broken && i < run->pipeline->count; i++)
        if (run->pipeline->stages[i].status == FF_STOPPED && status != FF_OK)
            return FF_STOPPED;
    return status;
}

ff_report *ff_run_report(ff_run *run)
{
    return run && !run->broken ? run->report : NULL;
}

const ff_node *ff_run_root(const ff_run *run)
{
    return run && !run->broken && run->tree ? fe_tree_root(run->tree) : NULL;
}

ff_pipeline *ff_run_pipeline(const ff_run *run)
{
    return run && !run->broken ? run->pipeline : NULL;
}
