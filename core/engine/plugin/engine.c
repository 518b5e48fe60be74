/* SPDX-License-Identifier: MIT */
/* The life of an engine, and the message of its last call. */
#include "../value/report.h"
#include "private.h"

#include <stdlib.h>

/* Calls the function with the mark of plugin code cleared, since no plugin's code runs in it.
 * The mark is restored however the function is left. */
static ff_status protect(fe_heap *heap, void (*function)(void *ctx), void *ctx)
{
    ff_guard_mark before = fe_guard_enter((ff_guard_mark){.path = NULL});
    ff_status status = fe_protected(heap, function, ctx);
    fe_guard_leave(before);
    return status;
}

static void clear_message(ff_engine *engine)
{
    fe_free(engine->report_text);
    engine->report_text = NULL;
    engine->message = "";
}

ff_status fe_engine_lack(ff_engine *engine)
{
    clear_message(engine);
    engine->message = "out of memory\n";
    return FF_NOMEM;
}

ff_status fe_engine_call(ff_engine *engine, fe_heap *heap, void (*function)(void *ctx), void *ctx)
{
    clear_message(engine);
    return protect(heap, function, ctx) == FF_OK ? FF_OK : fe_engine_lack(engine);
}

void fe_engine_set_message(ff_engine *engine, const ff_report *report)
{
    clear_message(engine);
    fe_heap *before = fe_heap_use(&engine->heap);
    engine->report_text = ff_report_text(report, false);
    engine->message = engine->report_text;
    fe_heap_use(before);
}

ff_status fe_status_of(const ff_report *report)
{
    static const ff_status statuses[] = {[FF_FAULT_NONE] = FF_OK,
                                         [FF_FAULT_RUN] = FF_NOCONV,
                                         [FF_FAULT_INPUT] = FF_INVALID,
                                         [FF_FAULT_PLUGIN] = FF_BUG};
    return fe_report_lacked_memory(report) ? FF_NOMEM : statuses[ff_report_fault(report)];
}

typedef struct new_call {
    ff_engine *engine;
    const ff_engine_options *options;
} new_call;

static void find_models(void *ctx)
{
    const new_call *call = ctx;
    const ff_engine_options *o = call->options;
    bool listed = o && FF_HAS(o, plugin_path_count);
    fe_search_path_new(&call->engine->search, listed ? o->plugin_paths : NULL,
                       listed ? o->plugin_path_count : 0);
}

ff_status ff_engine_new(const ff_engine_options *options, ff_engine **engine)
{
    if (!engine)
        return FF_INVALID;
    new_call call = {.engine = calloc(1, sizeof **engine), .options = options};
    *engine = call.engine;
    ff_status status = call.engine
                           ? fe_engine_call(call.engine, &call.engine->heap, find_models, &call)
                           : FF_NOMEM;
    if (status != FF_OK) {
        ff_engine_close(*engine);
        *engine = NULL;
    }
    return status;
}

void ff_engine_close(ff_engine *engine)
{
    if (!engine)
        return;
    fe_heap_close(&engine->heap);
    free(engine);
}

const char *ff_engine_message(const ff_engine *engine)
{
    return engine ? engine->message : "";
}

ff_status ff_protected(void (*function)(void *ctx), void *ctx)
{
    fe_heap heap = {.blocks = NULL};
    ff_status status = protect(&heap, function, ctx);
    fe_heap_close(&heap);
    return status;
}
