/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps results of stages on disk, for other cases and runs with the same inputs. */
#ifndef STUDY_REUSE_H
#define STUDY_REUSE_H

#include <flankfilm/engine.h>
#include <jansson.h>

typedef struct study_reuse_stats { /* of a stage, in this process */
    double seconds;                /* s of its last evaluation; 0 if unknown */
    size_t idle;                   /* bytes kept since a kept result was last reused */
} study_reuse_stats;

typedef struct study_reuse {
    int directory;                /* descriptor; -1 if nothing is kept */
    const uint64_t *fingerprints; /* of this case, by stage */
    study_reuse_stats *stats;     /* by stage */
    const bool *fresh;            /* by stage: must be computed anew; NULL if none must */
    json_t
        *warnings; /* warnings logged by models; a stage with some is computed anew in each case */
    int held;      /* descriptor of the locked file of the stage that is being computed; -1: none */
    char name[20]; /* of that file */
} study_reuse;

/* Removes everything that is kept in the directory of a study, given by its descriptor. */
void study_reuse_clear(int study);

/* Callbacks of ff_observer, whose ctx is a study_reuse. */
bool study_reuse_recall(void *ctx, const ff_pipeline *pipeline, ff_stage *stage);
void study_reuse_keep(void *ctx, const ff_pipeline *pipeline, const ff_stage *stage);

#endif
