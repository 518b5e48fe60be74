/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a dynamic model reads from gear, duty and mesh, checked and made dimensionless. */
#ifndef DYNAMICS_INPUTS_H
#define DYNAMICS_INPUTS_H

#include "excitation.h"

#include <flankfilm/plugin.h>

enum {
    DYNAMICS_IN_ROLL_ANGLE,
    DYNAMICS_IN_ROLL_SAP,
    DYNAMICS_IN_TEETH,
    DYNAMICS_IN_BACKLASH,
    DYNAMICS_IN_EQUIVALENT_MASS,
    DYNAMICS_IN_MESH_FREQUENCY,
    DYNAMICS_IN_LINE_FORCE,
    DYNAMICS_IN_PHASE,
    DYNAMICS_IN_STIFFNESS,
    DYNAMICS_IN_STIFFNESS_MEAN,
    DYNAMICS_IN_TRANSMISSION_ERROR,
    DYNAMICS_IN_TOOTH_FORCE,
    DYNAMICS_IN_LOAD_SHARE,
    DYNAMICS_INPUT_COUNT,
    /* read only by a model whose gears move on their bearings */
    DYNAMICS_IN_BASE_RADIUS = DYNAMICS_INPUT_COUNT,
    DYNAMICS_IN_CENTRE_DISTANCE,
    DYNAMICS_IN_MASS,
    DYNAMICS_COUPLED_INPUT_COUNT
};

extern const ff_port dynamics_input_ports[DYNAMICS_COUPLED_INPUT_COUNT];

/* The inertia that the user gives; both 0: that of the gear. */
typedef struct dynamics_inertia {
    double equivalent_mass, natural_frequency; /* kg, Hz */
} dynamics_inertia;

typedef struct dynamics_inputs {
    double line_force, mesh_frequency, natural_frequency; /* N, Hz, Hz */
    size_t stations;
    const double *roll_angle, *tooth_force, *load_share; /* load_share may be NULL */
    double roll_sap, pitch; /* rad; pitch: roll angle of one mesh cycle */
} dynamics_inputs;

/* Checks and reads all inputs. `excitation` has its zeta and damping set, and is freed by
   dynamics_excitation_free. */
ff_status dynamics_inputs_read(const ff_host *host, const ff_array *in,
                               const dynamics_inertia *inertia, dynamics_inputs *inputs,
                               dynamics_excitation *excitation);

/* A parameter that is a number or `auto`, which is 0. */
size_t dynamics_count_or_auto(const ff_value *value);

/* Fills in the ends of an atlas that are not given (0), Hz, by the natural frequency. */
ff_status dynamics_atlas_bounds(const ff_host *host, double natural, double *from, double *to);

/* The natural frequency of the linear system at the mean stiffness, sqrt(k/m)/(2 pi), Hz; 0: no
   mass is known. */
ff_status dynamics_natural_frequency(const ff_host *host, const dynamics_inertia *inertia,
                                     const ff_array *gear_mass, double stiffness,
                                     double *frequency);

#endif
