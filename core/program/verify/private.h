/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of core/program/verify alone. A child process lives for one test and frees
   nothing but what is the model's. */
#ifndef VERIFY_PRIVATE_H
#define VERIFY_PRIVATE_H

#include "verify.h"

#include "../../engine/plugin/environment.h"

#include <flankfilm/verifier.h>

/* What a child tells its parent; lies in memory that both share. */
typedef struct verify_slate {
    bool told;
    verify_finding finding;
    char doing[128]; /* the call at hand */
    char why[512];
} verify_slate;

/* The first word is kept. */
void verify_slate_say(verify_slate *slate, verify_finding finding, const char *text);

/* The subject as the verifier sees it. */
typedef struct verify_examined {
    ff_exam exam;
    const fe_loaded *loaded;
    verify_slate *slate;
    fe_report *said; /* of the text that was read last */
    fe_environment environment;
    fe_surroundings around;
} verify_examined;

/* From now on nothing of the process may change. */
void verify_exam_begin(verify_examined *subject, fe_library *library);

/* Gives the exam the values of the stage of the pipeline file that uses the model, and when `run`
   what the other stages feed it; false with errors in the report. */
bool verify_exam_give(verify_examined *subject, const verify_request *request, fe_library *library,
                      bool run, fe_report *report);

/* Of each service input a plain law that its kind has; NULL: none. */
const void **verify_plain_laws(fe_library *library, const fe_loaded *loaded);

#endif
