/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Conformance of one plugin, by named tests: rules for any model, and rules of its kind. Each
 * test runs in a child process with a time limit, so that a crash, a hang or a call of exit() is
 * a finding like any other. */
#ifndef VERIFY_H
#define VERIFY_H

#include <flankfilm/engine.h>

typedef enum verify_finding {
    VERIFY_PASSED,
    VERIFY_FAILED,
    VERIFY_SKIPPED, /* `why` says what is missing for it */
    VERIFY_LISTED   /* not run, since only a list was requested */
} verify_finding;

typedef struct verify_result {
    const char *test, *claim; /* such as "derivatives", "derivatives agree with differences" */
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
    bool list;        /* list the tests without running them */
} verify_request;

/* Tests that do not apply to the model are left out. Without a model, or without the requested
 * parameters, nothing else is tried. Calls `tell` after each test. False, with an error, if
 * there is nothing to test. */
bool verify_plugin(const verify_request *request,
                   void (*tell)(void *ctx, size_t number, const verify_result *result), void *ctx,
                   ff_report *report);

#endif
