/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models that a file leaves open: `use: KIND/auto`. */
#ifndef ACCURACY_MODELS_H
#define ACCURACY_MODELS_H

#include "../memory/memory.h"

#include <flankfilm/engine.h>

/* Gives each stage that says KIND/auto its reference model, and then builds the pipeline as
 * run_build does. Returns NULL only if no pipeline can be shown. */
ff_pipeline *accuracy_build_alone(ff_run *run, ff_engine *engine, bool everything);
/* Builds as accuracy_build_alone does, and checks the file's accuracy request. */
ff_pipeline *accuracy_build(ff_run *run, ff_engine *engine, bool everything);

/* Returns the value "ehl/auto" of the stage's `use`; NULL if the stage names its model. */
const char *accuracy_open_use(const ff_stage *stage);
bool accuracy_is_open_use(const char *use); /* true for KIND/auto */

/* Returns the models that may replace the reference, those with a lower stated cost, cheapest
 * first, ended by NULL. */
const char **accuracy_candidates(const ff_stage *stage, ff_engine *engine, memory_arena *arena);

/* Returns the part of a case's key that concerns accuracy: its goals and the models that may be
 * chosen, "2 %; film: ehl/film-formula 1a2b"; "" if the file asks for none. To be freed. */
char *accuracy_print_key(const ff_run *run, ff_engine *engine);

#endif
