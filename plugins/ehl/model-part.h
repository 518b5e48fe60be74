/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Declares what the files of the film model share. */
#ifndef EHL_MODEL_PART_H
#define EHL_MODEL_PART_H

#include "history.h"
#include "inlet-heating.h"
#include "model.h"
#include "tune.h"

typedef struct ehl_model {
    const ff_host *host;
    ehl_solver_maker *maker;
    size_t cells, steps;  /* steps 0: chosen automatically */
    double inlet, outlet; /* multiples of the half-width; 0: chosen automatically */
    int scheme, wedge, conserving;
    double tolerance, time_tolerance, light_load;
    ehl_inlet_heating heating;
    double contact_film, boundary_friction, hardness, valley_length;
    int ventilated, smooth;
    ehl_laws laws;
    int given; /* EHL_TUNE_... flags of what the user wrote */
    int roughness_given;
    char text[3][32]; /* text and reason belong to the last assessment */
    char reason[400];
    ff_proposal proposals[4];
} ehl_model;

/* Reads and checks the contact that the inputs give. */
ff_status ehl_read_history(const ehl_model *m, const ff_array *in, ehl_history *h);

#endif
