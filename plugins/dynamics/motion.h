/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A steady motion and what it means for the teeth: the outputs of the dynamic models. */
#ifndef FF_DYNAMICS_MOTION_H
#define FF_DYNAMICS_MOTION_H

#include "inputs.h"
#include "oscillator.h"

enum {
    FF_OUT_PHASE,
    FF_OUT_DTE,
    FF_OUT_DTE_VELOCITY,
    FF_OUT_MESH_FORCE,
    FF_OUT_DTE_RMS,
    FF_OUT_DTE_MEAN,
    FF_OUT_DTE_PEAK_TO_PEAK,
    FF_OUT_TOOTH_FORCE,
    FF_OUT_GAP,
    FF_OUT_DYNAMIC_FACTOR_TOOTH,
    FF_OUT_DYNAMIC_FACTOR_MESH,
    FF_OUT_CONTACT_LOSS,
    FF_OUT_BACK_CONTACT,
    FF_OUT_NATURAL_FREQUENCY,
    FF_OUT_PERIOD,
    FF_OUT_FLOQUET_MAX,
    FF_OUT_MULTIPLIERS,
    FF_OUT_DTE_HARMONICS,
    FF_MOTION_OUTPUT_COUNT,
    /* of other motions at the speed */
    FF_OUT_STABLE_MOTIONS = FF_MOTION_OUTPUT_COUNT,
    FF_SPEED_OUTPUT_COUNT,
    /* of the models that know all motions over a range of speeds */
    FF_OUT_ATLAS_FREQUENCY = FF_SPEED_OUTPUT_COUNT,
    FF_OUT_ATLAS_RMS,
    FF_OUT_ATLAS_STABLE,
    FF_OUT_ATLAS_BRANCH,
    FF_OUT_ATLAS_FLOQUET_MAX,
    FF_OUT_FOLD_FREQUENCY,
    FF_OUT_FOLD_BRANCH,
    FF_OUT_DOUBLING_FREQUENCY,
    FF_OUT_DOUBLING_BRANCH,
    FF_ATLAS_OUTPUT_COUNT
};

extern const ff_port ff_motion_outputs[FF_ATLAS_OUTPUT_COUNT];

typedef struct ff_motion {
    const ff_mesh *mesh;
    int period;       /* mesh cycles, 0: aperiodic, -1: unbounded */
    size_t cycles;    /* that the outputs show */
    double T;         /* duration of a mesh cycle */
    ff_record record; /* of `cycles` and as many more as a tooth pair stays in mesh */
    ff_clocks clocks; /* over `cycles` */
    double monodromy[4];
    double det_error;    /* of det M against exp(-2 zeta t) while the damper acts */
    double energy_error; /* energy brought in less lost less stored, over the energies */
} ff_motion;

/* Mesh cycles from SAP to the last station, rounded up. */
size_t ff_mesh_cycles_of_engagement(const ff_inputs *inputs);

/* Records the motion that starts at (delta, rate). `motion` has mesh, period, cycles, T set and is
   freed by ff_record_free(&motion->record). FF_NOCONV: too many steps. */
ff_status ff_motion_record(ff_motion *motion, const ff_inputs *inputs, double tolerance,
                           size_t per_cycle, double delta, double rate);

/* Complex pairs (re, im) of the multipliers; returns the largest modulus. */
double ff_motion_multipliers(const ff_motion *motion, double multipliers[4]);

/* rms of the alternating part of s, in units of mesh->length. */
double ff_motion_rms(const ff_motion *motion);

ff_status ff_motion_put(const ff_motion *motion, const ff_inputs *inputs, const ff_host *host);

#endif
