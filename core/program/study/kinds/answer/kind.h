/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A kind of study whose later cases depend on results of earlier ones, as a struct of functions. */
#ifndef STUDY_KIND_H
#define STUDY_KIND_H

#include "answer.h"

typedef struct study_kind {
    const char *name; /* the key under `study:` */
    const char *verb; /* a verb for messages: "maps" */
    const char *summary;
    const char *file; /* name of its files: "map" */
    /* the keys below it; a key without a type may be a value, a list or a map */
    const ff_param *keys;
    size_t key_count;
    /* Reads the keys, sets the context and submits the first cases. Returns the kind's data, which
     * live as long as the context, or NULL after an error. */
    void *(*read)(study_context *context, const study_key_value *values);
    /* Runs the cases and submits others; returns false if the study cannot continue. */
    bool (*cases)(void *study);
    /* Evaluates the results and writes the answer. */
    void (*reduce)(void *study, study_answer *answer);
    /* Checks that need the pipeline; NULL: none. */
    void (*check)(const void *study, const ff_pipeline *pipeline, ff_report *report);
} study_kind;

extern const study_kind *const study_kinds[]; /* ended by NULL */

#endif
