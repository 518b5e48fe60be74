/* SPDX-License-Identifier: MIT */
/* Shared by core/engine/instance*.c alone. */
#ifndef FE_INSTANCE_H
#define FE_INSTANCE_H

#include "plugin/engine.h"

#include "pipeline/build.h"

/* What is connected to an input: the output of another instance, an array or a table. */
typedef struct fe_feed {
    ff_instance *from;
    int output;       /* of `from` */
    uint64_t version; /* of the object, or the run, of `from` that was taken */
    ff_array array;
    size_t shape[FF_MAX_RANK];
    const void *table;
} fe_feed;

struct ff_instance {
    ff_engine *engine;
    fe_heap heap;         /* of all but the struct itself */
    bool broken;          /* it had no memory once, and can only be closed */
    ff_pipeline pipeline; /* of the stage alone */
    struct fe_pipeline_memory memory;
    ff_stage stage;
    fe_instance object;
    ff_report *report;
    ff_observer observer;
    ff_value *given, *presets;     /* of each parameter; size 0: none */
    char **names;                  /* of each, for messages: "barus.alpha"; NULL: not needed yet */
    fe_feed *feeds;                /* of each input */
    const ff_guard_mark **serving; /* the services that the object may call */
    bool evaluated;                /* the last evaluation of the object was good */
    bool failed;                   /* the last run was not */
    uint64_t version, runs;        /* how often the object was made, and run */
    char item[96], reason[1024];
};

/* The arguments of a public function, and what does its work. */
typedef struct fe_request {
    ff_instance *instance, *other;
    bool (*work)(struct fe_request *request); /* false after an error */
    ff_status status;                         /* that it came to */
    const char *name, *text;
    const double *si;
    size_t count;
    const ff_array *array;
    const void *table, **fetched;
    ff_status (*call)(void *ctx);
    void *ctx;
} fe_request;

/* Forgets the messages of the last call, works, and says how it went. */
ff_status fe_handle(fe_request *request);

/* Reports 'barus: <text>' with the item at fault. Returns false. */
bool fe_refuse(ff_instance *instance, const char *item, const char *format, ...) FF_PRINTF(3, 4);
/* Refuses a call without an argument; FF_INVALID. The instance may be what is absent. */
ff_status fe_absent(const ff_instance *instance, const char *argument);
/* Reports that it has no such parameter or output, with the nearest of its names. Returns false. */
bool fe_refuse_name(ff_instance *instance, const char *what, const char *name,
                    const char *const *names, size_t count);
/* Makes the object of the model, unless it is up to date. */
bool fe_make_object(ff_instance *instance);
/* Ends the object, which is made anew when it is needed: it has what is about to change. */
void fe_drop_object(ff_instance *instance);
/* Whether anything is connected. */
bool fe_is_fed(const fe_feed *feed);
/* Adds the messages of another instance, whose call came to the status. False when that failed. */
bool fe_pass_on(ff_instance *instance, const ff_instance *from, ff_status status);

#endif
