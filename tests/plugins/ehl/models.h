/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film models and what each claims: the tests of all models run through this table. */
#ifndef TEST_EHL_MODELS_H
#define TEST_EHL_MODELS_H

#include "line.h"

typedef struct film_model {
    const char *id, *name;
    int solves;   /* for the pressure: keeps load and mass, has an order in space and in time */
    size_t cells; /* of short tests */
    size_t steps; /* of short histories */
    /* Distance of the films from full solutions with M 2 to 200 and L 0 to 15. */
    double least, central;
} film_model;

enum { FILM_MODELS = 5 };

extern const film_model film_models[FILM_MODELS];

/* A line contact (line.h) for that model, with its cells. */
void model_open(const film_model *m, line *c);

/* Every output that a contact without a roll angle has: all numbers are finite, those of lengths
   not negative. The error of h_min may be infinite: it is not known. The run must have asked for
   model_outputs. */
const char *model_outputs(const film_model *m);
int model_is_finite(const film_model *m, const line *c);

#endif
