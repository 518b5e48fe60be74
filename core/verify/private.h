/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of core/verify alone. A child process lives for one test and frees nothing
   but what is the model's. */
#ifndef FF_VERIFY_PRIVATE_H
#define FF_VERIFY_PRIVATE_H

#include "verify.h"

#include "../plugin/environment.h"

#include <flankfilm/verifier.h>

/* What a child tells its parent; lies in memory that both share. */
typedef struct ff_slate {
    bool told;
    ff_finding finding;
    char doing[128]; /* the call at hand */
    char why[512];
} ff_slate;

/* The first word is kept. */
void ff_slate_say(ff_slate *slate, ff_finding finding, const char *text);

/* The subject as the verifier sees it. */
typedef struct ff_subject {
    ff_exam exam;
    const ff_loaded *loaded;
    ff_slate *slate;
    ff_report *said; /* of the text that was read last */
    ff_environment environment;
    ff_surroundings around;
} ff_subject;

/* From now on nothing of the process may change. */
void ff_exam_begin(ff_subject *subject, ff_library *library);

/* Gives the exam the values of the stage of the pipeline file that uses the model, and when `run`
   what the other stages feed it; false with errors in the report. */
bool ff_exam_give(ff_subject *subject, const ff_verify *request, ff_library *library, bool run,
                  ff_report *report);

/* Of each service input a plain law that its kind has; NULL: none. */
const void **ff_plain_laws(ff_library *library, const ff_loaded *loaded);

#endif
