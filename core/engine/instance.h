/* SPDX-License-Identifier: MIT */
/* Shared by the files core/engine/instance*.c only. */
#ifndef FE_INSTANCE_H
#define FE_INSTANCE_H

#include "plugin/engine.h"

#include "pipeline/build.h"

/* The source of an input: an output of another instance, an array or a table. */
typedef struct fe_feed {
    ff_instance *from;
    int output;       /* index of the output of `from` */
    uint64_t version; /* run of `from` that gave the array, or object that gave the table */
    ff_array array;
    size_t shape[FF_MAX_RANK];
    const void *table;
} fe_feed;

struct ff_instance {
    ff_engine *engine;
    fe_heap heap;         /* holds everything except this struct */
    bool broken;          /* an allocation failed once; the instance can only be closed */
    ff_pipeline pipeline; /* its only stage is this instance */
    struct fe_pipeline_memory memory;
    ff_stage stage;
    fe_instance object;
    ff_report *report;
    ff_observer observer;
    ff_value *given, *presets; /* by parameter; size 0: no value */
    char **names;              /* by parameter, for messages: "barus.alpha"; NULL: not needed yet */
    fe_feed *feeds;            /* by input */
    const ff_guard_mark **serving; /* marks of the services that the object may call */
    bool evaluated;                /* the last evaluation of the object succeeded */
    bool failed;                   /* the last run failed */
    uint64_t version, runs;        /* how often the object was created, and run */
    char item[96], reason[1024];
};

/* The arguments of a public function, and the function that does its work. */
typedef struct fe_request {
    ff_instance *instance, *other;
    bool (*work)(struct fe_request *request); /* false after an error */
    ff_status status;                         /* result of the call */
    const char *name, *text;
    const double *si;
    size_t count;
    const ff_array *array;
    const void *table, **fetched;
    ff_status (*call)(void *ctx);
    void *ctx;
} fe_request;

/* Drops the messages of the last call, does the work, and returns its status. */
ff_status fe_handle(fe_request *request);

/* Reports 'barus: <text>' with the item at fault. Returns false. */
bool fe_refuse(ff_instance *instance, const char *item, const char *format, ...) FF_PRINTF(3, 4);
/* Reports that an argument is NULL and returns FF_INVALID. The instance itself may be the missing
   argument. */
ff_status fe_absent(const ff_instance *instance, const char *argument);
/* Reports that there is no such parameter or output, with the nearest name. Returns false. */
bool fe_refuse_name(ff_instance *instance, const char *what, const char *name,
                    const char *const *names, size_t count);
/* Creates the object of the model, unless it is up to date. */
bool fe_make_object(ff_instance *instance);
/* Destroys the object because its settings are about to change; it is created again when it is
   needed. */
void fe_drop_object(ff_instance *instance);
/* Whether the input is connected. */
bool fe_is_fed(const fe_feed *feed);
/* Adds the messages of another instance, whose call returned `status`. False if that call
   failed. */
bool fe_pass_on(ff_instance *instance, const ff_instance *from, ff_status status);

#endif
