/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cheaper models in the place of the references that a file leaves to the program (models.h). */
#ifndef ACCURACY_CHOICE_H
#define ACCURACY_CHOICE_H

#include "measure.h"
#include "twin.h"

/* A model that was tried. */
typedef struct accuracy_tried {
    size_t stage; /* in the pipeline */
    const char *model;
    bool taken;
    const char *reason; /* "film.h_min may be off by 12 %, ..."; NULL: taken */
} accuracy_tried;

/* What a model that was taken adds to the error of an output. */
typedef struct accuracy_change {
    size_t stage;       /* whose model it is */
    size_t of;          /* the stage of the output */
    const char *output; /* "h_min" */
    double error;       /* relative */
} accuracy_change;

/* Starts zeroed. */
typedef struct accuracy_choice {
    const char **uses; /* "film.use=ehl/film-formula", of all stages that leave it open */
    size_t use_count;
    accuracy_tried *tried;
    size_t tried_count;
    accuracy_change *changes;
    size_t change_count;
    bool differs; /* some model was taken in place of a reference */
    size_t runs;
    double seconds; /* s: CPU time of them */
    memory_arena arena;
} accuracy_choice;

/*
 * Tries, from the first stage to the last, the models that cost less than the reference, the
 * cheapest first, and takes the first with which all outputs that have a goal stay well within it.
 * `base` was run with the references and `settings`, and its errors measured; `like` has its
 * stages. A try differs from what was taken before by one model. False where the observer stopped
 * it.
 */
bool accuracy_choose(accuracy_choice *choice, const accuracy_scene *scene,
                     const accuracy_twin *base, const accuracy_record *measured,
                     const char *const *settings, size_t setting_count);
void accuracy_choice_free(accuracy_choice *choice);

#endif
