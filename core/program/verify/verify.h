/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Conformance of one plugin: named tests, each in a child process with a time limit, so that a
 * crash, a hang or a call of exit() is a finding like any other: what any model owes, and what its
 * kind asks.
 */
#ifndef VERIFY_H
#define VERIFY_H

#include <flankfilm/engine.h>

typedef enum verify_finding {
    VERIFY_PASSED,
    VERIFY_FAILED,
    VERIFY_SKIPPED, /* `why` says what is missing to try it */
    VERIFY_LISTED   /* not run, since the tests were asked for alone */
} verify_finding;

typedef struct verify_result {
    const char *test, *claim; /* "derivatives", "derivatives agree with differences" */
    verify_finding finding;
    char why[512]; /* "" when passed */
    double seconds;
} verify_result;

typedef struct verify_request {
    const char *path;        /* .../kind/name.so */
    const char *pipeline;    /* YAML file with a stage that uses the model; NULL: none */
    const char *const *sets; /* changes to that file */
    size_t set_count;
    double limit;     /* seconds that a test may take */
    const char *only; /* names of tests, between commas; NULL: all */
    bool list;        /* tell which tests there are, and run none */
} verify_request;

/* Tests that do not concern the model are left out; without a model, or without the parameters
   asked for, nothing else is tried. Calls `tell` after each. False, with an error, when there is
   nothing to test. */
bool verify_plugin(const verify_request *request,
                   void (*tell)(void *ctx, size_t number, const verify_result *result), void *ctx,
                   ff_report *report);

#endif
