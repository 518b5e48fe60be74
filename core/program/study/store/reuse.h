/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps results of stages on disk, for other cases and runs with the same inputs. */
#ifndef STUDY_REUSE_H
#define STUDY_REUSE_H

#include <flankfilm/engine.h>
#include <jansson.h>

typedef struct study_reuse_stats { /* of a stage, in this process */
    double seconds;                /* s that its last evaluation took; 0 when unknown */
    size_t idle;                   /* bytes kept since a kept result was last reused */
} study_reuse_stats;

typedef struct study_reuse {
    int directory;                /* file descriptor; -1 when nothing is kept */
    const uint64_t *fingerprints; /* of this case, one for each stage */
    study_reuse_stats *stats;     /* one for each stage */
    const bool *fresh; /* whether each stage must be computed anew; NULL when none must */
    json_t *warnings;  /* that models log; what has some is computed anew in each case */
    int held; /* descriptor of the locked file of the stage that is being computed; -1 for none */
    char name[20]; /* of that file */
} study_reuse;

/* Removes all that is kept in the directory of a study, given by its descriptor. */
void study_reuse_clear(int study);

/* Callbacks of ff_observer, whose ctx is a study_reuse. */
bool study_reuse_recall(void *ctx, const ff_pipeline *pipeline, ff_stage *stage);
void study_reuse_keep(void *ctx, const ff_pipeline *pipeline, const ff_stage *stage);

#endif
