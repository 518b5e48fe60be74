/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters, ports and life cycle of the line-contact film models, which differ in the solver
   alone. */
#ifndef EHL_STAGE_H
#define EHL_STAGE_H

#include "assess.h"
#include "history.h"
#include "inlet.h"
#include "solver.h"

#include <flankfilm/plugin.h>

enum {
    EHL_IN_TIME,
    EHL_IN_RADIUS,
    EHL_IN_SPEED_1,
    EHL_IN_SPEED_2,
    EHL_IN_LOAD,
    EHL_IN_MODULUS,
    EHL_IN_ROLL,
    EHL_IN_GAP,
    EHL_IN_ENGAGEMENT,
    EHL_IN_VISCOSITY,
    EHL_IN_DENSITY,
    EHL_IN_RHEOLOGY,
    EHL_IN_POSITION,
    EHL_IN_HEIGHT_1,
    EHL_IN_HEIGHT_2,
    EHL_IN_RQ_1,
    EHL_IN_RQ_2,
    EHL_IN_PERIOD,
    EHL_IN_ORIGIN,
    EHL_IN_ROUGHNESS,
    EHL_IN_DISCRETISATION, /* of ehl/finite-volume alone */
    EHL_INPUTS
};

/* The series over time come first. */
enum {
    EHL_TIME,
    EHL_ROLL_ANGLE,
    EHL_ENGAGEMENT,
    EHL_H_MIN,
    EHL_H_CENTRAL,
    EHL_P_MAX,
    EHL_FRICTION_COEFFICIENT,
    EHL_TRACTION,
    EHL_POWER_LOSS,
    EHL_SLIDING_LOSS,
    EHL_ROLLING_LOSS,
    EHL_SQUEEZE_LOSS,
    EHL_ASPERITY_LOSS,
    EHL_LOAD_ERROR,
    EHL_MASS_ERROR,
    EHL_H_MIN_ERROR,
    EHL_H_CENTRAL_ERROR,
    EHL_ONE_WAY_GAP_ERROR,
    EHL_ASPERITY_LOAD_SHARE,
    EHL_CONTACT_RATIO,
    EHL_TRAPPED_SHARE,
    EHL_YIELD_SHARE,
    EHL_PLASTIC_DEPTH_MAX,
    EHL_LAMBDA_RATIO,
    EHL_SERIES,
    EHL_X = EHL_SERIES,
    EHL_FIRST_FIELD,
    EHL_FILM = EHL_FIRST_FIELD,
    EHL_PRESSURE,
    EHL_FILM_FRACTION,
    EHL_ASPERITY_PRESSURE,
    EHL_PLASTIC_DEPTH,
    EHL_FIELDS_END,
    EHL_FIELDS = EHL_FIELDS_END - EHL_FIRST_FIELD,
    EHL_H_MIN_LOWEST = EHL_FIELDS_END,
    EHL_H_MIN_LOWEST_AT,
    EHL_H_MIN_LOWEST_MEAN,
    EHL_H_MIN_LOWEST_SPREAD,
    EHL_ENGAGEMENTS_JUDGED,
    EHL_P_MAX_HIGHEST,
    EHL_LAMBDA_RATIO_LOWEST,
    EHL_NEWTON_STEPS,
    EHL_CONVOLUTIONS,
    EHL_STEPS_CUT,
    EHL_OUTPUTS
};

extern const ff_port ehl_inputs[EHL_INPUTS];
extern const ff_port ehl_outputs[EHL_OUTPUTS];

ff_status ehl_create(const ff_host *host, const ff_model *model, ehl_solver_maker *maker,
                     void **self);
ff_status ehl_wire(void *self, uint32_t input, const void *service);
ff_status ehl_evaluate(void *self, uint64_t wanted, const ff_array *in);
/* step_cost returns the seconds that a step takes with that many cells. */
ff_status ehl_assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                     double (*step_cost)(double cells), ff_assessment *a);
ff_status ehl_judge(void *self, uint64_t wanted, uint32_t input, const void *service,
                    const ff_array *in, ff_assessment *a);
void ehl_destroy(void *self);

/* Declares what the files of the film model share. */

/* Ranks of the words of cavitation, valleys and roughness. */
enum { EHL_CONSERVING = 1, EHL_VENTILATED = 1, EHL_IGNORED = 1 };

typedef struct ehl_model {
    const ff_host *host;
    const ff_model *model; /* its descriptor */
    ehl_solver_maker *maker;
    /* parameters, by their names; auto and none read as -1 or NaN, a word as its rank */
    int64_t cells, steps;
    double inlet, outlet, time_tolerance, tolerance, light_load;
    int32_t time_scheme, wedge, cavitation, valleys, roughness;
    double contact_film, boundary_friction, asperity_hardness, valley_length;
    ehl_inlet_heating heating;
    ehl_laws laws;
    const ff_film *outside; /* NULL: the solver of `maker` */
    char text[3][32];       /* text and reason belong to the last assessment */
    char reason[400];
    ff_proposal proposals[4];
} ehl_model;

/* Reads and checks the contact that the inputs give. */
ff_status ehl_read_history(const ehl_model *m, const ff_array *in, ehl_history *h);

#endif
