/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film models and the accuracy of each, for tests that run with every model. */
#ifndef TEST_EHL_MODELS_H
#define TEST_EHL_MODELS_H

#include "line.h"

typedef struct film_model {
    const char *id, *name;
    int solves;   /* whether the model solves for the pressure, so that load and mass are in
                     balance, and errors decrease with cells and steps */
    size_t cells; /* in short tests */
    size_t steps; /* in short histories */
    /* Largest relative error of h_min and h_central, compared with full solutions, for M 2 to 200
       and L 0 to 15. */
    double least, central;
} film_model;

enum { FILM_MODELS = 5 };

extern const film_model film_models[FILM_MODELS];

/* Opens a line contact (line.h) for a model, with the model's number of cells. */
void model_open(const film_model *m, line *c);

/* Checks every output of a contact without a roll angle: all numbers must be finite, and lengths
   not negative. The error of h_min may be infinite, if it is not known. The run must request
   model_outputs. */
const char *model_outputs(const film_model *m);
int model_is_finite(const film_model *m, const line *c);

#endif
