/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs of mesh stiffness models from the gear and from the operating point. */
#ifndef STIFFNESS_INPUTS_H
#define STIFFNESS_INPUTS_H

#include <flankfilm/plugin.h>

/* In the order of the rows. A table uses the rows of the path of contact, which come first; a
   standard uses all rows; other models use all rows except the pinion. */
enum {
    STIFFNESS_IN_ROLL,
    STIFFNESS_IN_SAP,
    STIFFNESS_IN_TIP,
    STIFFNESS_IN_TEETH,
    STIFFNESS_IN_FORCE,
    STIFFNESS_IN_REFERENCE_FORCE,
    STIFFNESS_IN_LARGEST_FORCE,
    STIFFNESS_PATH_INPUTS,
    STIFFNESS_IN_PROFILE_ROLL = STIFFNESS_PATH_INPUTS,
    STIFFNESS_IN_PROFILE_DEVIATION,
    STIFFNESS_IN_BACK_PROFILE_ROLL,
    STIFFNESS_IN_BACK_PROFILE_DEVIATION,
    STIFFNESS_IN_INDEX_1,
    STIFFNESS_IN_INDEX_2,
    STIFFNESS_IN_BASE,
    STIFFNESS_IN_REFERENCE,
    STIFFNESS_IN_ROOT,
    STIFFNESS_IN_BORE,
    STIFFNESS_IN_THICKNESS,
    STIFFNESS_IN_ANGLE,
    STIFFNESS_IN_WIDTH,
    STIFFNESS_IN_MODULUS,
    STIFFNESS_IN_POISSON,
    STIFFNESS_IN_BACKLASH,
    STIFFNESS_IN_ALLOWANCE,
    STIFFNESS_IN_TOOL_TIP,
    STIFFNESS_BODY_INPUTS,
    STIFFNESS_IN_PINION = STIFFNESS_BODY_INPUTS,
    STIFFNESS_INPUTS
};
extern const ff_port stiffness_inputs[STIFFNESS_INPUTS];

/* Reads element i of an input, 0 for a scalar; FF_INVALID if it is missing or not finite. */
ff_status stiffness_input_read(const ff_host *host, const ff_array *in, int row, size_t i,
                               double *value);

#endif
