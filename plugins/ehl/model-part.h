/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of the solvers' model share among themselves. */
#ifndef EHL_MODEL_PART_H
#define EHL_MODEL_PART_H

#include "history.h"
#include "inlet-heating.h"
#include "model.h"
#include "tune.h"

typedef struct ehl_model {
    const ff_host *host;
    ehl_solver_maker *maker;
    size_t cells, steps;  /* steps 0: auto */
    double inlet, outlet; /* 0: auto */
    int scheme, wedge, conserving;
    double tolerance, time_tolerance, light_load;
    ehl_inlet_heating heating;
    double contact_film, boundary_friction, hardness, valley_length;
    int ventilated, smooth;
    ehl_laws laws;
    int given; /* EHL_TUNE_... that the user wrote */
    int roughness_given;
    char text[3][32]; /* of the last assessment: its proposals and its reason */
    char reason[400];
    ff_proposal proposals[4];
} ehl_model;

/* The contact that the inputs give, checked. */
ff_status ehl_read_history(const ehl_model *m, const ff_array *in, ehl_history *h);

#endif
