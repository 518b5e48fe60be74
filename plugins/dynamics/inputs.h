/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a dynamic model reads from gear, duty and mesh, checked and made dimensionless. */
#ifndef FF_DYNAMICS_INPUTS_H
#define FF_DYNAMICS_INPUTS_H

#include "mesh.h"

#include <flankfilm/plugin.h>

enum {
    FF_IN_ROLL_ANGLE,
    FF_IN_ROLL_SAP,
    FF_IN_TEETH,
    FF_IN_BACKLASH,
    FF_IN_EQUIVALENT_MASS,
    FF_IN_MESH_FREQUENCY,
    FF_IN_LINE_FORCE,
    FF_IN_PHASE,
    FF_IN_STIFFNESS,
    FF_IN_STIFFNESS_MEAN,
    FF_IN_TRANSMISSION_ERROR,
    FF_IN_TOOTH_FORCE,
    FF_IN_LOAD_SHARE,
    FF_INPUT_COUNT,
    /* of the models whose gears move on their bearings */
    FF_IN_BASE_RADIUS = FF_INPUT_COUNT,
    FF_IN_CENTRE_DISTANCE,
    FF_IN_MASS,
    FF_COUPLED_INPUT_COUNT
};

extern const ff_port ff_dynamics_inputs[FF_COUPLED_INPUT_COUNT];

/* The user's choice of the inertia; both 0: the gear's. */
typedef struct ff_inertia {
    double equivalent_mass, natural_frequency; /* kg, Hz */
} ff_inertia;

typedef struct ff_inputs {
    double line_force, mesh_frequency, natural_frequency; /* N, Hz, Hz */
    size_t stations;
    const double *roll_angle, *tooth_force, *load_share; /* load_share may be NULL */
    double roll_sap, pitch; /* rad; pitch: roll angle of one mesh cycle */
} ff_inputs;

/* Reads all; `mesh` has its zeta and damping set and is freed by ff_mesh_free. */
ff_status ff_inputs_read(const ff_host *host, const ff_array *in, const ff_inertia *inertia,
                         ff_inputs *inputs, ff_mesh *mesh);

/* Natural frequency of the linear system at the mean stiffness, Hz; 0: no mass is known. */
ff_status ff_natural_frequency(const ff_host *host, const ff_inertia *inertia,
                               const ff_array *gear_mass, double stiffness, double *frequency);

#endif
