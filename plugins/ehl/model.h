/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters, ports and life of the line-contact film models; only the solver differs. */
#ifndef FF_EHL_MODEL_H
#define FF_EHL_MODEL_H

#include "solver.h"

#include <flankfilm/plugin.h>

enum {
    FF_EHL_CELLS,
    FF_EHL_INLET,
    FF_EHL_OUTLET,
    FF_EHL_STEPS,
    FF_EHL_TIME_TOLERANCE,
    FF_EHL_TIME_SCHEME,
    FF_EHL_WEDGE,
    FF_EHL_CAVITATION,
    FF_EHL_TOLERANCE,
    FF_EHL_LIGHT_LOAD,
    FF_EHL_OIL_CONDUCTIVITY,
    FF_EHL_TEMPERATURE_SLOPE,
    FF_EHL_CONTACT_FILM,
    FF_EHL_BOUNDARY_FRICTION,
    FF_EHL_ASPERITY_HARDNESS,
    FF_EHL_VALLEYS,
    FF_EHL_VALLEY_LENGTH,
    FF_EHL_ROUGHNESS,
    FF_EHL_PARAMS
};

enum {
    FF_EHL_IN_TIME,
    FF_EHL_IN_RADIUS,
    FF_EHL_IN_SPEED_1,
    FF_EHL_IN_SPEED_2,
    FF_EHL_IN_LOAD,
    FF_EHL_IN_MODULUS,
    FF_EHL_IN_ROLL,
    FF_EHL_IN_GAP,
    FF_EHL_IN_ENGAGEMENT,
    FF_EHL_IN_VISCOSITY,
    FF_EHL_IN_DENSITY,
    FF_EHL_IN_RHEOLOGY,
    FF_EHL_IN_POSITION,
    FF_EHL_IN_HEIGHT_1,
    FF_EHL_IN_HEIGHT_2,
    FF_EHL_IN_RQ_1,
    FF_EHL_IN_RQ_2,
    FF_EHL_IN_PERIOD,
    FF_EHL_IN_ORIGIN,
    FF_EHL_IN_ROUGHNESS,
    FF_EHL_INPUTS
};

/* The series over time come first. */
enum {
    FF_EHL_TIME,
    FF_EHL_ROLL_ANGLE,
    FF_EHL_ENGAGEMENT,
    FF_EHL_H_MIN,
    FF_EHL_H_CENTRAL,
    FF_EHL_P_MAX,
    FF_EHL_FRICTION_COEFFICIENT,
    FF_EHL_TRACTION,
    FF_EHL_POWER_LOSS,
    FF_EHL_SLIDING_LOSS,
    FF_EHL_ROLLING_LOSS,
    FF_EHL_SQUEEZE_LOSS,
    FF_EHL_ASPERITY_LOSS,
    FF_EHL_LOAD_ERROR,
    FF_EHL_MASS_ERROR,
    FF_EHL_H_MIN_ERROR,
    FF_EHL_H_CENTRAL_ERROR,
    FF_EHL_ONE_WAY_GAP_ERROR,
    FF_EHL_ASPERITY_LOAD_SHARE,
    FF_EHL_CONTACT_RATIO,
    FF_EHL_TRAPPED_SHARE,
    FF_EHL_YIELD_SHARE,
    FF_EHL_PLASTIC_DEPTH_MAX,
    FF_EHL_LAMBDA_RATIO,
    FF_EHL_SERIES,
    FF_EHL_X = FF_EHL_SERIES,
    FF_EHL_FIRST_FIELD,
    FF_EHL_FILM = FF_EHL_FIRST_FIELD,
    FF_EHL_PRESSURE,
    FF_EHL_FILM_FRACTION,
    FF_EHL_ASPERITY_PRESSURE,
    FF_EHL_PLASTIC_DEPTH,
    FF_EHL_FIELDS_END,
    FF_EHL_FIELDS = FF_EHL_FIELDS_END - FF_EHL_FIRST_FIELD,
    FF_EHL_H_MIN_LOWEST = FF_EHL_FIELDS_END,
    FF_EHL_H_MIN_LOWEST_AT,
    FF_EHL_H_MIN_LOWEST_MEAN,
    FF_EHL_H_MIN_LOWEST_SPREAD,
    FF_EHL_ENGAGEMENTS_JUDGED,
    FF_EHL_P_MAX_HIGHEST,
    FF_EHL_LAMBDA_RATIO_LOWEST,
    FF_EHL_NEWTON_STEPS,
    FF_EHL_CONVOLUTIONS,
    FF_EHL_STEPS_CUT,
    FF_EHL_OUTPUTS
};

extern const ff_param ff_ehl_params[FF_EHL_PARAMS];
extern const ff_port ff_ehl_inputs[FF_EHL_INPUTS];
extern const ff_port ff_ehl_outputs[FF_EHL_OUTPUTS];

ff_status ff_ehl_create(const ff_host *host, ff_solver_maker *maker, void **self);
ff_status ff_ehl_set(void *self, uint32_t param, const ff_value *value);
ff_status ff_ehl_wire(void *self, uint32_t input, const void *service);
ff_status ff_ehl_evaluate(void *self, uint64_t wanted, const ff_array *in);
/* With the seconds that a step takes with that many cells. */
ff_status ff_ehl_assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        double (*step_cost)(double cells), ff_assessment *a);
ff_status ff_ehl_judge(void *self, uint64_t wanted, uint32_t input, const void *service,
                       const ff_array *in, ff_assessment *a);
void ff_ehl_destroy(void *self);

#endif
