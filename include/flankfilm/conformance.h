/* Draft: may change until a release freezes it. SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.conformance/1": what the models of one kind owe beyond what any model owes.
 *
 * The model conformance/KIND offers it. `flankfilm verify` looks for that model on the search path
 * and runs its checks on every model of that kind, each in a process of its own with a time limit:
 * a check may therefore leave memory behind, and a crash is a finding.
 */
#ifndef FLANKFILM_CONFORMANCE_H
#define FLANKFILM_CONFORMANCE_H

#include "author.h"

#define FF_CONFORMANCE_ID   "flankfilm.conformance/1"
#define FF_CONFORMANCE_KIND "conformance"

/* The model under test, and what a check works it with. */
typedef struct ff_fixture {
    size_t size;
    void *ctx;             /* first argument of every function below */
    const ff_model *model; /* under test */

    /* What is tried next: names the call in which a crash or a hang is found. */
    void (*step)(void *ctx, const char *text);
    /* A check that calls neither has passed; the first call counts. NULL to `skip`: the check does
       not concern this model and is left out of the list. */
    void (*fail)(void *ctx, const char *text);
    void (*skip)(void *ctx, const char *text);
    double (*random)(void *ctx); /* [0, 1), the same numbers in every run */

    /* Memory for `count` numbers, NaN at first, between guard zones; and whether these are still as
       they were. It lives until the check ends. */
    double *(*numbers)(void *ctx, size_t count);
    int32_t (*is_intact)(void *ctx, const double *numbers, size_t count);

    /*
     * What the next instances are made of. They begin with the parameters and inputs of the user's
     * run (--pipeline); without one, with random parameters inside their calibrated range, plain
     * laws and no data. Once something is set, given or served, presets stand in place of random
     * parameters, save for required ones.
     * `set` takes a value as a user writes it; `give` copies, NULL data disconnects, a NULL name
     * disconnects all; `serve` takes the table of a law. 0: the model has no such row.
     */
    int32_t (*set)(void *ctx, const char *param, const char *text);
    int32_t (*give)(void *ctx, const char *input, uint32_t rank, const size_t *shape,
                    const double *data);
    int32_t (*serve)(void *ctx, const char *wire, const void *table);

    /* A new instance that is ready; NULL when there is none: then `skip` has been called. */
    void *(*open)(void *ctx);
    const void *(*service)(void *ctx, void *instance, uint32_t output);
    /* wanted: "h_min p_max", names that the model does not have are left out; NULL: all. What a
       model refuses to serve is done without. */
    ff_status (*evaluate)(void *ctx, void *instance, const char *wanted);
    /* An input "gear.teeth" as it was given, or an output of the last evaluation; data NULL: there
       is none. */
    ff_array (*array)(void *ctx, void *instance, const char *name);
    const char *(*why)(void *ctx, void *instance); /* the last refusal, "" without */
    void (*close)(void *ctx, void *instance);      /* accepts NULL */

    int32_t from_run; /* 1: instances begin with the user's run */
} ff_fixture;

typedef struct ff_check {
    const char *name;  /* "balance" */
    const char *claim; /* one line: what holds */
    void (*run)(const ff_fixture *fixture);
} ff_check;

typedef struct ff_conformance {
    size_t size;
    const ff_check *checks;
    size_t check_count, check_stride;
    const char *service; /* the interface that models of this kind offer; NULL: none */
    const void *plain;   /* its simplest law, which stages under test are fed with */
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
