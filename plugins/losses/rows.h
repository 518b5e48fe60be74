/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of inputs and outputs of losses/tooth-mesh. */
#ifndef LOSSES_ROWS_H
#define LOSSES_ROWS_H

#include "../numerics/gear-heat.h"

#include <flankfilm/plugin.h>

enum {
    OUT_PHASE,
    OUT_MESH_POWER_LOSS,
    OUT_POWER_LOSS_MEAN,
    OUT_SLIDING_LOSS_MEAN, /* this and the next three rows have the order of the inputs */
    OUT_ROLLING_LOSS_MEAN,
    OUT_SQUEEZE_LOSS_MEAN,
    OUT_ASPERITY_LOSS_MEAN,
    OUT_ENGAGEMENTS_JUDGED,
    OUT_ENGAGEMENT_LOSS,
    OUT_POWER_LOSS_SPREAD,
    OUT_POWER_INPUT,
    OUT_EFFICIENCY,
    OUT_FRICTION_MEAN,
    OUT_FRICTION_FORMULA,
    OUT_FRICTION_AGREEMENT,
    OUT_LOSS_FACTOR,
    OUT_ROLL_ANGLE,
    OUT_ENGAGEMENT,
    OUT_POWER_LOSS,
    OUT_FLASH,
    OUT_CONTACT_TEMPERATURE,
    OUT_FLASH_MAX,
    OUT_FLASH_MAX_AT,
    OUT_BULK_TEMPERATURE,
    OUT_CONTACT_TEMPERATURE_MAX,
    LOSSES_OUTPUTS
};

enum {
    IN_ROLL_ANGLE,
    IN_POWER_LOSS,
    IN_SLIDING_LOSS, /* this and the next three rows: the parts of the loss */
    IN_ROLLING_LOSS,
    IN_SQUEEZE_LOSS,
    IN_ASPERITY_LOSS,
    IN_ENGAGEMENT,
    IN_TRACTION,
    IN_FRICTION_COEFFICIENT,
    IN_STATION,
    IN_RADIUS_1,
    IN_RADIUS_2,
    IN_TEETH,
    IN_FACE_WIDTH,
    IN_REDUCED_MODULUS,
    IN_CONTACT_RATIO,
    IN_TORQUE,
    IN_SPEED,
    IN_OIL_TEMPERATURE,
    IN_ROUGHNESS,
    IN_RQ_1,
    IN_RQ_2,
    IN_OIL,
    IN_HEAT, /* three rows: thermal data of the gears */
    IN_BACK_ROLL_ANGLE = IN_HEAT + NUMERICS_HEAT_INPUTS,
    IN_BACK_LOSS_MEAN, /* five rows: mean losses of the back flanks, in the order of the outputs
                          from OUT_POWER_LOSS_MEAN on */
    LOSSES_INPUTS = IN_BACK_LOSS_MEAN + OUT_ASPERITY_LOSS_MEAN - OUT_POWER_LOSS_MEAN + 1
};

enum { PARTS = IN_ASPERITY_LOSS - IN_SLIDING_LOSS + 1 };

extern const ff_port losses_inputs[LOSSES_INPUTS];
extern const ff_port losses_outputs[LOSSES_OUTPUTS];

#endif
