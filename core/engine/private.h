/* SPDX-License-Identifier: MIT */
/* Shared by the files of the public face: how a call is bracketed and says what went wrong. */
#ifndef FE_ENGINE_PRIVATE_H
#define FE_ENGINE_PRIVATE_H

#include <flankfilm/engine.h>

#include "value/memory.h"

struct ff_engine {
    fe_heap heap;
    ff_library *library;
    char *said;          /* by the last call, in the heap; NULL: nothing */
    const char *message; /* that, or a constant text */
};

/* Calls function(ctx) with the memory of `heap`, of an object of the engine. The message is ""
   until fe_engine_say. FF_OK, or FF_NOMEM, which is said then. */
ff_status fe_engine_call(ff_engine *engine, fe_heap *heap, void (*function)(void *ctx), void *ctx);

/* The answer of a call of an object that had no memory once. It is said. */
ff_status fe_engine_lack(ff_engine *engine);

/* Makes the messages of the report the message of the engine. Inside fe_engine_call. */
void fe_engine_say(ff_engine *engine, const ff_report *report);

/* The status of a call that left these messages. */
ff_status fe_status_of(const ff_report *report);

/* Whether the values are there: FF_NOCONV and FF_STOPPED are failures above 0. */
static inline bool fe_is_good(ff_status status)
{
    return status == FF_OK || status == FF_DOMAIN;
}

#endif
