/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The values of a file that have a tolerance, and how a sample spreads them. */
#ifndef STUDY_TOLERANCES_H
#define STUDY_TOLERANCES_H

#include <flankfilm/engine.h>

#include "../memory/memory.h"

typedef struct study_toleranced {
    const char *path; /* as --set takes it */
    ff_place place;
    ff_tolerance tolerance;
} study_toleranced;

/* All of them in the stages of the pipeline, in the order of the file; of the sets under `with:`
   those of the model that is used. */
study_toleranced *study_find_toleranced(const ff_node *root, memory_arena *arena, size_t *count);

typedef enum study_spread {
    STUDY_NO_SPREAD,
    STUDY_UNIFORM, /* as likely everywhere between both ends */
    STUDY_NORMAL   /* half the tolerance is three standard deviations; nothing is beyond */
} study_spread;

study_spread study_spread_of(const char *word);

/* The value below which that share of all values lies, in the unit of the tolerance. */
double study_spread_value(study_spread spread, const ff_tolerance *t, double share);

#endif
