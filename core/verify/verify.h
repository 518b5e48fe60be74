/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Conformance of one plugin: named tests, each in a child process with a time limit, so that a
 * crash, a hang or a call of exit() is a finding like any other. The tests are those of a verifier
 * and of the subject's kind.
 */
#ifndef FF_VERIFY_H
#define FF_VERIFY_H

#include "../pipeline/pipeline.h"

typedef enum ff_finding {
    FF_PASSED,
    FF_FAULTY,
    FF_UNTRIED /* there was nothing to try it with: `why` says what is missing */
} ff_finding;

typedef struct ff_verdict {
    const char *test, *claim; /* "derivatives", "derivatives agree with differences" */
    ff_finding finding;
    char why[512]; /* "" when passed */
    double seconds;
} ff_verdict;

typedef struct ff_verify {
    const char *path;        /* .../kind/name.so */
    const char *pipeline;    /* YAML file with a stage that uses the model; NULL: none */
    const char *const *sets; /* changes to that file */
    size_t set_count;
    double limit; /* seconds that a test may take */
} ff_verify;

/* Tests that do not concern the model are left out; without a model, or without the parameters
   asked for, nothing else is tried. Calls `tell` after each. False, with an error, when there is
   nothing to test. */
bool ff_verify_plugin(const ff_verify *request,
                      void (*tell)(void *ctx, size_t number, const ff_verdict *verdict), void *ctx,
                      ff_report *report);

#endif
