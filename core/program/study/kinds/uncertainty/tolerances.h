/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the values of a file that have a tolerance. */
#ifndef STUDY_TOLERANCES_H
#define STUDY_TOLERANCES_H

#include <flankfilm/engine.h>

#include "../../../memory/memory.h"

typedef struct study_toleranced {
    const char *path; /* as for --set */
    const char *text; /* "3 mm +- 1 mm" */
    ff_tolerance tolerance;
} study_toleranced;

/* Returns the values with a tolerance in all stages, in the order of the file. Sets under `with:`
   are ignored, except the set of the model in use. */
study_toleranced *study_find_toleranced(const ff_node *root, memory_arena *arena, size_t *count);

#endif
