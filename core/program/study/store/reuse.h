/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stores results of stages on the disk, for other cases and runs with the same inputs. */
#ifndef STUDY_REUSE_H
#define STUDY_REUSE_H

#include <flankfilm/engine.h>
#include <jansson.h>

typedef struct study_reuse_stats { /* statistics of a stage in this process */
    double seconds;                /* duration of its last evaluation, s; 0 if unknown */
    size_t idle;                   /* bytes stored since a stored result was last reused */
} study_reuse_stats;

typedef struct study_reuse {
    int directory;                /* descriptor of the directory; -1: results are not stored */
    const uint64_t *fingerprints; /* hash of each stage in this case */
    study_reuse_stats *stats;     /* one per stage */
    const bool *fresh;            /* whether each stage must be computed anew; NULL: none must */
    json_t *warnings; /* warnings logged by each model; a stage with warnings is computed anew in
                         each case */
    int held;      /* descriptor of the locked file of the stage that is being computed; -1: none */
    char name[20]; /* name of that file */
} study_reuse;

/* Removes all stored results in the directory of a study, given by its descriptor. */
void study_reuse_clear(int study);

/* Callbacks of ff_observer. Their ctx is a study_reuse. */
bool study_reuse_recall(void *ctx, const ff_pipeline *pipeline, ff_stage *stage);
void study_reuse_keep(void *ctx, const ff_pipeline *pipeline, const ff_stage *stage);

#endif
