/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models that a file leaves to the program: `use: KIND/auto`. */
#ifndef ACCURACY_MODELS_H
#define ACCURACY_MODELS_H

#include "../memory/memory.h"

#include <flankfilm/engine.h>

/*
 * Gives each stage that says KIND/auto its reference, the model that the others of the kind are
 * held against: the one under `reference`, else the first under `with`, else the one that costs
 * most; of a law it is an error where the file names none. False after an error.
 */
bool accuracy_name_references(ff_run *run, ff_engine *engine);

/* The same, then builds the pipeline as run_build does. NULL only when nothing can be shown. */
ff_pipeline *accuracy_build_alone(ff_run *run, ff_engine *engine, bool everything);
/* The same, then checks what the file says of accuracy. */
ff_pipeline *accuracy_build(ff_run *run, ff_engine *engine, bool everything);

/* What the stage of such a pipeline says, "ehl/auto"; NULL: it names its model. */
const char *accuracy_open_use(const ff_stage *stage);
bool accuracy_is_open_use(const char *use); /* whether it is KIND/auto */

/* The models that may take the place of the reference, cheapest first, ended by NULL: those that
   say what they cost, which is less. */
const char **accuracy_candidates(const ff_stage *stage, ff_engine *engine, memory_arena *arena);

/* What of the accuracy a case depends on, for its key: the goals, and the models that may be
   chosen, "2 %; film: ehl/film-formula 1a2b"; "" where none is asked for. To be freed. */
char *accuracy_print_key(const ff_run *run, ff_engine *engine);

#endif
