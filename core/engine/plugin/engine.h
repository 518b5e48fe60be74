/* SPDX-License-Identifier: MIT */
/* An engine: its models, and the bracket around each call of it that collects its messages. */
#ifndef FE_ENGINE_H
#define FE_ENGINE_H

#include <flankfilm/engine.h>

#include "../value/memory.h"

/* Directories in the order in which they are searched. */
typedef struct fe_search_path {
    char **directories;
    size_t count;
} fe_search_path;

struct ff_engine {
    fe_heap heap; /* all memory that it keeps */
    fe_search_path search;
    ff_loaded **models; /* the loaded ones */
    size_t count;
    char **ids; /* of all models that can be found; NULL: not searched yet */
    size_t id_count;
    char *said;          /* the message of the last call; NULL: none */
    const char *message; /* `said`, or a constant text */
};

/* Calls function(ctx) with `heap` in use, which belongs to an object of the engine. The message
 * is "" until fe_engine_say. FF_OK, or FF_NOMEM with its message. */
ff_status fe_engine_call(ff_engine *engine, fe_heap *heap, void (*function)(void *ctx), void *ctx);

/* Refuses a call of an object that once ran out of memory, with a message. */
ff_status fe_engine_lack(ff_engine *engine);

/* Makes the messages of the report the message of the engine. To be called inside
 * fe_engine_call. */
void fe_engine_say(ff_engine *engine, const ff_report *report);

/* Whether the bytes of the model's file were changed in place, which changes its code while it
 * runs. A new file under the same path does no harm. May be called in a signal handler. */
bool fe_is_written_over(const ff_loaded *loaded);

/* Warns if other files also have the id of the model. */
void fe_warn_displaced(const ff_loaded *loaded, ff_report *report);

/* Returns the status of a call that left these messages. */
ff_status fe_status_of(const ff_report *report);

#endif
