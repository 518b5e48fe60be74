/* SPDX-License-Identifier: MIT */
/* An engine: its models, and how a call of it is bracketed and says what went wrong. */
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
    fe_heap heap; /* of all that it keeps */
    fe_search_path search;
    ff_loaded **models; /* that were loaded */
    size_t count;
    char **ids; /* of all that can be found; NULL: they were not looked for yet */
    size_t id_count;
    char *said;          /* by the last call; NULL: nothing */
    const char *message; /* that, or a constant text */
};

/* Calls function(ctx) with the memory of `heap`, of an object of the engine. The message is ""
   until fe_engine_say. FF_OK, or FF_NOMEM, which is said then. */
ff_status fe_engine_call(ff_engine *engine, fe_heap *heap, void (*function)(void *ctx), void *ctx);

/* The answer of a call of an object that had no memory once. It is said. */
ff_status fe_engine_lack(ff_engine *engine);

/* Makes the messages of the report the message of the engine. Inside fe_engine_call. */
void fe_engine_say(ff_engine *engine, const ff_report *report);

/* Whether the file of the model has other bytes now, in the same place of the disk: then its code
   has changed while it runs. A file that takes its place does no harm. May be called in a handler
   of signals. */
bool fe_is_written_over(const ff_loaded *loaded);

/* Warns if other files have the id of the model, too. */
void fe_warn_displaced(const ff_loaded *loaded, ff_report *report);

/* The status of a call that left these messages. */
ff_status fe_status_of(const ff_report *report);

#endif
