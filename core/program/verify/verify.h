/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Conformance of one plugin: named tests, each in a child process with a time limit, so that a
 * crash, a hang or a call of exit() is a finding like any other. The tests are those of a verifier
 * and of the subject's kind.
 */
#ifndef VERIFY_H
#define VERIFY_H

#include "../../engine/pipeline/pipeline.h"

typedef enum verify_finding {
    VERIFY_PASSED,
    VERIFY_FAULTY,
    VERIFY_UNTRIED /* there was nothing to try it with: `why` says what is missing */
} verify_finding;

typedef struct study_case_verdict {
    const char *test, *claim; /* "derivatives", "derivatives agree with differences" */
    verify_finding finding;
    char why[512]; /* "" when passed */
    double seconds;
} study_case_verdict;

typedef struct verify_request {
    const char *path;        /* .../kind/name.so */
    const char *pipeline;    /* YAML file with a stage that uses the model; NULL: none */
    const char *const *sets; /* changes to that file */
    size_t set_count;
    double limit; /* seconds that a test may take */
} verify_request;

/* Tests that do not concern the model are left out; without a model, or without the parameters
   asked for, nothing else is tried. Calls `tell` after each. False, with an error, when there is
   nothing to test. */
bool verify_plugin(const verify_request *request,
                   void (*tell)(void *ctx, size_t number, const study_case_verdict *verdict),
                   void *ctx, fe_report *report);

#endif
