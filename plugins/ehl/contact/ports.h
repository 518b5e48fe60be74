/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs and outputs of the models of the film. */
#ifndef EHL_PORTS_H
#define EHL_PORTS_H

#include "../../numerics/gear-heat.h"
#include "history.h"
#include "liquid.h"

#include <flankfilm/plugin.h>

/* Inputs of the models that solve for the pressure. The rows up to those of the oil are the inputs
   of every model. */
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
    EHL_IN_RHEOLOGY_AT_PRESSURE,
    EHL_IN_OIL,
    EHL_IN_LIQUID = EHL_IN_OIL + EHL_OIL_ROWS,
    EHL_IN_POSITION,
    EHL_IN_HEIGHT_1,
    EHL_IN_HEIGHT_2,
    EHL_IN_RQ_1,
    EHL_IN_RQ_2,
    EHL_IN_PERIOD,
    EHL_IN_ORIGIN,
    EHL_IN_ROUGHNESS,
    EHL_IN_HEAT, /* first of three rows: thermal data of the gears */
    EHL_IN_HARDNESS = EHL_IN_HEAT + NUMERICS_HEAT_INPUTS,
    EHL_IN_SHEAR_RATE,
    EHL_IN_ASPERITIES, /* asperity pressure of flanks whose roughness is given by its statistics */
    EHL_IN_CUTOFF,
    EHL_IN_BULK,
    EHL_IN_DISCRETISATION, /* for ehl/finite-volume only */
    EHL_INPUTS
};

/* Inputs of the estimates, after those of the oil. */
enum {
    EHL_ESTIMATE_IN_RQ_1 = EHL_IN_LIQUID + 1,
    EHL_ESTIMATE_IN_RQ_2,
    EHL_ESTIMATE_IN_ROUGHNESS,
    EHL_ESTIMATE_IN_HEAT, /* first of three rows: thermal data of the gears */
    EHL_ESTIMATE_IN_HARDNESS = EHL_ESTIMATE_IN_HEAT + NUMERICS_HEAT_INPUTS,
    EHL_ESTIMATE_IN_ASPERITIES,
    EHL_ESTIMATE_IN_BULK,
    EHL_ESTIMATE_INPUTS
};

/* Outputs of the models that solve for the pressure. The time series come first. */
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
    EHL_LOAD_AHEAD,
    EHL_MASS_ERROR,
    EHL_H_MIN_ERROR,
    EHL_H_CENTRAL_ERROR,
    EHL_P_MAX_ERROR,
    EHL_ONE_WAY_GAP_ERROR,
    EHL_ASPERITY_LOAD_SHARE,
    EHL_CONTACT_RATIO,
    EHL_TRAPPED_SHARE,
    EHL_YIELD_SHARE,
    EHL_PLASTIC_DEPTH_MAX,
    EHL_LAMBDA_RATIO,
    EHL_TEMPERATURE_MAX,
    EHL_FLASH_TEMPERATURE,
    EHL_SEPARATION,
    EHL_LOAD_PER_WIDTH,
    EHL_SERIES,
    EHL_X = EHL_SERIES,
    EHL_FIRST_FIELD,
    EHL_FILM = EHL_FIRST_FIELD,
    EHL_PRESSURE,
    EHL_FILM_FRACTION,
    EHL_ASPERITY_PRESSURE,
    EHL_PLASTIC_DEPTH,
    EHL_ROUGHNESS,
    EHL_TEMPERATURE,
    EHL_FIELDS_END,
    EHL_FIELDS = EHL_FIELDS_END - EHL_FIRST_FIELD,
    EHL_H_MIN_LOWEST = EHL_FIELDS_END,
    EHL_H_MIN_LOWEST_AT,
    EHL_H_MIN_LOWEST_MEAN,
    EHL_H_MIN_LOWEST_SPREAD,
    EHL_ENGAGEMENTS_JUDGED,
    EHL_P_MAX_HIGHEST,
    EHL_LAMBDA_RATIO_LOWEST,
    EHL_RQ_LEFT_OUT,
    EHL_NEWTON_STEPS,
    EHL_CONVOLUTIONS,
    EHL_STEPS_CUT,
    EHL_ALPHA_STAR,
    EHL_BULK_TEMPERATURE,
    EHL_FILM_AT_LANDING,
    EHL_FILM_AT_LANDING_ERROR,
    EHL_P_MAX_AT_LANDING,
    EHL_P_MAX_AT_LANDING_ERROR,
    EHL_OUTPUTS
};

/* Outputs of the estimates. The time series come first. */
enum {
    EHL_ESTIMATE_TIME,
    EHL_ESTIMATE_ROLL_ANGLE,
    EHL_ESTIMATE_ENGAGEMENT,
    EHL_ESTIMATE_H_MIN,
    EHL_ESTIMATE_H_CENTRAL,
    EHL_ESTIMATE_P_MAX,
    EHL_ESTIMATE_FRICTION_COEFFICIENT,
    EHL_ESTIMATE_TRACTION,
    EHL_ESTIMATE_POWER_LOSS,
    EHL_ESTIMATE_SLIDING_LOSS,
    EHL_ESTIMATE_ROLLING_LOSS,
    EHL_ESTIMATE_SQUEEZE_LOSS,
    EHL_ESTIMATE_ASPERITY_LOSS,
    EHL_ESTIMATE_H_MIN_ERROR,
    EHL_ESTIMATE_LAMBDA_RATIO,
    EHL_ESTIMATE_ASPERITY_LOAD_SHARE,
    EHL_ESTIMATE_LOAD_PER_WIDTH,
    EHL_ESTIMATE_SERIES,
    EHL_ESTIMATE_X = EHL_ESTIMATE_SERIES,
    EHL_ESTIMATE_FILM,
    EHL_ESTIMATE_PRESSURE,
    EHL_ESTIMATE_H_MIN_LOWEST,
    EHL_ESTIMATE_H_MIN_LOWEST_AT,
    EHL_ESTIMATE_P_MAX_HIGHEST,
    EHL_ESTIMATE_LAMBDA_RATIO_LOWEST,
    EHL_ESTIMATE_H_MIN_LOWEST_MEAN,
    EHL_ESTIMATE_H_MIN_LOWEST_SPREAD,
    EHL_ESTIMATE_ENGAGEMENTS_JUDGED,
    EHL_ESTIMATE_ALPHA_STAR,
    EHL_ESTIMATE_BULK_TEMPERATURE,
    EHL_ESTIMATE_OUTPUTS
};

extern const ff_port ehl_inputs[EHL_INPUTS];
extern const ff_port ehl_outputs[EHL_OUTPUTS];

extern const ff_port ehl_estimate_inputs[EHL_ESTIMATE_INPUTS];
extern const ff_port ehl_estimate_outputs[EHL_ESTIMATE_OUTPUTS];

/* Reads and checks the contact. Loads below `light_load` are replaced by `light_load`; NaN: no
   lower bound. */
ff_status ehl_read_history(const ff_host *host, const ff_array *in, double light_load,
                           ehl_history *h);

/* Sets the law that belongs to an input. Inputs that are no law are ignored. */
void ehl_wire_law(ehl_laws *laws, uint32_t input, const void *service);

#endif
