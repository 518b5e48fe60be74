/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Conformance of one plugin, by named tests: rules for any model, and rules of its kind. Each test
   runs in a child process with a time limit, so that a crash, a hang or a call of exit() is
   reported as a finding. */
#ifndef VERIFY_H
#define VERIFY_H

#include <flankfilm/engine.h>

typedef enum verify_finding {
    VERIFY_PASSED,
    VERIFY_FAILED,
    VERIFY_SKIPPED, /* `why` names what is missing for the test */
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
    const char *const *sets; /* settings that change that file */
    size_t set_count;
    double limit;     /* time limit of a test, s */
    const char *only; /* comma-separated names of tests; NULL: all */
    bool list;        /* list the tests without running them */
} verify_request;

/* Runs the tests that apply to the model. If the model cannot be loaded, or no accepted parameters
   exist, no other test is run. Calls `tell` after each test. Returns false, with an error, if there
   is nothing to test. */
bool verify_plugin(const verify_request *request,
                   void (*tell)(void *ctx, size_t number, const verify_result *result), void *ctx,
                   ff_report *report);

#endif
