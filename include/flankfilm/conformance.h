/* Draft: may change until a release freezes it. SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.conformance/1": checks that apply to all models of one kind, in addition to
 * the checks of any model.
 *
 * The model conformance/KIND offers it. `flankfilm verify` looks for that model on the search path
 * and runs its checks on each model of that kind. Each check runs in a process of its own with a
 * time limit. A check may therefore leak memory, and a crash counts as a failed check.
 */
#ifndef FLANKFILM_CONFORMANCE_H
#define FLANKFILM_CONFORMANCE_H

#include "author.h"

#define FF_CONFORMANCE_ID   "flankfilm.conformance/1"
#define FF_CONFORMANCE_KIND "conformance"

/* The model under test and the functions that a check uses. */
typedef struct ff_fixture {
    size_t size;
    void *ctx;             /* first argument of every function below */
    const ff_model *model; /* under test */

    /* Names the next call: a crash or a hang is reported for it. */
    void (*step)(void *ctx, const char *text);
    /* Ends the check as failed or skipped; only the first call counts. A check that calls neither
       has passed. skip(NULL): the check does not apply to this model and is not listed. */
    void (*fail)(void *ctx, const char *text);
    void (*skip)(void *ctx, const char *text);
    double (*random)(void *ctx); /* in [0, 1); the same sequence in every run */

    /* `numbers` allocates `count` numbers, initialised to NaN, between guard zones; they are valid
       until the check ends. `is_intact` tells whether the guard zones are unchanged. */
    double *(*numbers)(void *ctx, size_t count);
    int32_t (*is_intact)(void *ctx, const double *numbers, size_t count);

    /*
     * Settings of the next instances. Initially these are the parameters and inputs of the user's
     * run (--pipeline). Without a run, they are random parameters inside their calibrated ranges,
     * simple laws, and no data. After the first set, give or serve, presets replace the random
     * values of all parameters that are not required. `set` takes a value as a user writes it.
     * `give` copies the data; NULL data disconnects the input, a NULL name disconnects all. `serve`
     * takes the table of a law. The result is 0 if the model has no such row.
     */
    int32_t (*set)(void *ctx, const char *param, const char *text);
    int32_t (*give)(void *ctx, const char *input, uint32_t rank, const size_t *shape,
                    const double *data);
    int32_t (*serve)(void *ctx, const char *wire, const void *table);

    /* Creates an instance and calls ready. NULL: this failed, and `skip` has been called. */
    void *(*open)(void *ctx);
    const void *(*service)(void *ctx, void *instance, uint32_t output);
    /* wanted: "h_min p_max", without error for names that the model does not have; NULL: all.
       Outputs that the model refuses are left out. */
    ff_status (*evaluate)(void *ctx, void *instance, const char *wanted);
    /* An input "gear.teeth" as it was given, or an output of the last evaluation; data is NULL if
       there is none. */
    ff_array (*array)(void *ctx, void *instance, const char *name);
    const char *(*why)(void *ctx, void *instance); /* reason of the last refusal, or "" */
    void (*close)(void *ctx, void *instance);      /* accepts NULL */

    int32_t from_run; /* 1: instances start from the user's run (--pipeline) */
} ff_fixture;

typedef struct ff_check {
    const char *name;  /* "balance" */
    const char *claim; /* one line: the property that is checked */
    void (*run)(const ff_fixture *fixture);
} ff_check;

typedef struct ff_conformance {
    size_t size;
    const ff_check *checks;
    size_t check_count, check_stride;
    const char *service; /* interface id of the service that models of this kind offer; NULL:
                            none */
    const void *plain;   /* table of its simplest law, which feeds the stages under test */
} ff_conformance;

/* Fails the check. Returns 0. */
FF_UNUSED FF_PRINTF(2, 3) static int ff_check_failf(const ff_fixture *fixture, const char *format,
                                                    ...)
{
    char text[512];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    fixture->fail(fixture->ctx, text);
    return 0;
}

#endif
