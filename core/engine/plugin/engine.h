/* SPDX-License-Identifier: MIT */
/* An engine: its models, and the bracket around each of its calls that collects messages. */
#ifndef FE_ENGINE_H
#define FE_ENGINE_H

#include <flankfilm/engine.h>

#include "../value/memory.h"

/* Directories in search order. */
typedef struct fe_search_path {
    char **directories;
    size_t count;
} fe_search_path;

struct ff_engine {
    fe_heap heap; /* holds all its memory */
    fe_search_path search;
    ff_loaded **models; /* the loaded models */
    size_t count;
    char **ids; /* ids of all models on the search path; NULL: not searched yet */
    size_t id_count;
    char *report_text;   /* messages of the last call; NULL: none */
    const char *message; /* `report_text`, or a constant text */
};

/* Calls function(ctx) with `heap` in use; the heap belongs to an object of the engine. The message
   is "" until fe_engine_set_message. FF_OK, or FF_NOMEM with its message. */
ff_status fe_engine_call(ff_engine *engine, fe_heap *heap, void (*function)(void *ctx), void *ctx);

/* Refuses a call to an object that once ran out of memory, with a message. */
ff_status fe_engine_lack(ff_engine *engine);

/* Makes the messages of the report the message of the engine. Call it inside fe_engine_call. */
void fe_engine_set_message(ff_engine *engine, const ff_report *report);

/* Whether the bytes of the model's file were changed in place, which changes its running code. A
   new file at the same path is harmless. Async-signal-safe. */
bool fe_is_written_over(const ff_loaded *loaded);

/* Warns if further files have the id of the model. */
void fe_warn_displaced(const ff_loaded *loaded, ff_report *report);

/* Returns the status that corresponds to these messages. */
ff_status fe_status_of(const ff_report *report);

#endif
