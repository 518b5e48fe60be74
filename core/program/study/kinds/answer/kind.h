/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A kind of study whose later cases depend on what earlier ones gave: one row of functions. */
#ifndef STUDY_KIND_H
#define STUDY_KIND_H

#include "answer.h"

typedef struct study_kind {
    const char *name; /* the key under `study:` */
    const char *verb; /* what it does, for messages: "maps" */
    const char *summary;
    const char *file; /* what its files are called: "map" */
    /* what may stand under it; a key without a type takes a value, a list or a map */
    const ff_param *keys;
    size_t key_count;
    /* Reads the keys, sets the context and submits the cases that are known; NULL after an error.
       What it returns lives as long as the context. */
    void *(*read)(study_context *context, const study_key_value *values);
    /* Runs the cases and submits others; false when the study cannot go on. */
    bool (*cases)(void *study);
    /* Says what they gave. */
    void (*reduce)(void *study, study_answer *answer);
    /* Checks what only the pipeline tells; NULL: nothing. */
    void (*check)(const void *study, const ff_pipeline *pipeline, ff_report *report);
} study_kind;

extern const study_kind *const study_kinds[]; /* NULL ends them */

#endif
