/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Replaces reference models by cheaper models in stages that say `use: KIND/auto` (models.h). */
#ifndef ACCURACY_CHOICE_H
#define ACCURACY_CHOICE_H

#include "measure.h"
#include "twin.h"

/* A model that was tried. */
typedef struct accuracy_tried {
    size_t stage; /* in the pipeline */
    const char *model;
    bool accepted;
    const char *reason; /* why it was rejected, such as "film.h_min may be off by 12 %, ...";
                           NULL if it was accepted */
} accuracy_tried;

/* The error that an accepted model adds to an output. */
typedef struct accuracy_change {
    size_t stage;        /* stage of the model */
    size_t output_stage; /* the stage of the output */
    const char *output;  /* "h_min" */
    double error;        /* relative, or in SI if the goal is absolute */
} accuracy_change;

/* Starts zeroed. */
typedef struct accuracy_choice {
    const char **uses; /* "film.use=ehl/film-formula", one for each stage that leaves its model
                          open */
    size_t use_count;
    accuracy_tried *tried;
    size_t tried_count;
    accuracy_change *changes;
    size_t change_count;
    bool differs; /* true if a model other than a reference was accepted */
    memory_arena arena;
} accuracy_choice;

/*
 * Goes through the stages in order and tries the models that cost less than the reference, cheapest
 * first. The first model with which all outputs stay well within their goals is accepted. `base`
 * was run with the reference models and `settings`; `measured` has its errors. Consecutive tries
 * differ by one model. Returns false if the observer stopped it.
 */
bool accuracy_choose(accuracy_choice *choice, const accuracy_scene *scene,
                     const accuracy_twin *base, const accuracy_record *measured,
                     const char *const *settings, size_t setting_count);
void accuracy_choice_free(accuracy_choice *choice);

#endif
