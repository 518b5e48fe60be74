/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A steady motion, its invariants, and the outputs of the models that follow from it. */
#ifndef DYNAMICS_MOTION_H
#define DYNAMICS_MOTION_H

#include "../excitation/film-wire.h"
#include "../excitation/inputs.h"
#include "oscillator.h"

enum {
    DYNAMICS_OUT_PHASE,
    DYNAMICS_OUT_DTE,
    DYNAMICS_OUT_DTE_VELOCITY,
    DYNAMICS_OUT_MESH_FORCE,
    DYNAMICS_OUT_DTE_RMS,
    DYNAMICS_OUT_DTE_MEAN,
    DYNAMICS_OUT_DTE_PEAK_TO_PEAK,
    DYNAMICS_OUT_TOOTH_FORCE,
    DYNAMICS_OUT_GAP,
    DYNAMICS_OUT_DYNAMIC_FACTOR_TOOTH,
    DYNAMICS_OUT_DYNAMIC_FACTOR_MESH,
    DYNAMICS_OUT_CONTACT_LOSS,
    DYNAMICS_OUT_BACK_CONTACT,
    DYNAMICS_OUT_NATURAL_FREQUENCY,
    DYNAMICS_OUT_PERIOD,
    DYNAMICS_OUT_FLOQUET_MAX,
    DYNAMICS_OUT_MULTIPLIERS,
    DYNAMICS_OUT_DTE_HARMONICS,
    DYNAMICS_OUT_LANDING_TIME,
    DYNAMICS_OUT_LANDING_SPEED,
    DYNAMICS_OUT_BACK_TOOTH_FORCE,
    DYNAMICS_OUT_BACK_GAP,
    DYNAMICS_OUT_BACK_FORCE_MEAN,
    DYNAMICS_MOTION_OUTPUT_COUNT,
    /* outputs about other motions at the same speed */
    DYNAMICS_OUT_STABLE_MOTIONS = DYNAMICS_MOTION_OUTPUT_COUNT,
    DYNAMICS_SPEED_OUTPUT_COUNT,
    /* outputs of models that find all motions over a range of speeds */
    DYNAMICS_OUT_ATLAS_FREQUENCY = DYNAMICS_SPEED_OUTPUT_COUNT,
    DYNAMICS_OUT_ATLAS_RMS,
    DYNAMICS_OUT_ATLAS_STABLE,
    DYNAMICS_OUT_ATLAS_BRANCH,
    DYNAMICS_OUT_ATLAS_FLOQUET_MAX,
    DYNAMICS_OUT_FOLD_FREQUENCY,
    DYNAMICS_OUT_FOLD_BRANCH,
    DYNAMICS_OUT_DOUBLING_FREQUENCY,
    DYNAMICS_OUT_DOUBLING_BRANCH,
    DYNAMICS_ATLAS_OUTPUT_COUNT,
    /* outputs of models that compute the powers */
    DYNAMICS_OUT_DAMPER_LOSS = DYNAMICS_ATLAS_OUTPUT_COUNT,
    DYNAMICS_OUT_SQUEEZE_LOSS,
    DYNAMICS_OUT_EXCITATION_POWER,
    DYNAMICS_OUT_TORQUE_POWER,
    DYNAMICS_OUT_FRICTION_WORK,
    DYNAMICS_OUT_FILM_POWER,
    DYNAMICS_POWER_OUTPUT_COUNT
};

extern const ff_port dynamics_motion_outputs[DYNAMICS_POWER_OUTPUT_COUNT];

typedef struct dynamics_motion {
    const dynamics_excitation *excitation;
    int period;             /* period in mesh cycles, or DYNAMICS_APERIODIC or DYNAMICS_UNBOUNDED */
    size_t cycles;          /* number of cycles that the outputs show */
    double T;               /* duration of a mesh cycle, in rad of the natural frequency */
    dynamics_record record; /* record of `cycles` cycles, and of further cycles as long as a tooth
                               pair stays in mesh */
    dynamics_clocks clocks; /* sums over `cycles` */
    double monodromy[4];
    const double *films;        /* film thicknesses at the start; NULL: no films, or not known */
    double in_oil[4][4];        /* monodromy in (delta, rate, films) of a motion with oil films */
    double loss, squeeze, work; /* energies over `cycles`: loss, taken by damper and films; squeeze,
                                   taken by the films alone; work, supplied by the excitation */
    double drag;                /* energy that friction and rolling took from the vibration */
    double thickness;           /* part of `work` that the loaded film supplies */
    double det_error;           /* relative error of det M */
    double energy_error; /* supplied energy minus lost and stored energy, relative to the sum of the
                            energies */
} dynamics_motion;

/* Returns the mesh cycles from the start of active profile (SAP) to the last station, rounded
   up. */
size_t dynamics_mesh_cycles_of_engagement(const dynamics_inputs *inputs);

/* Records the motion that starts at (delta, rate). The members excitation, period, cycles and T of
   `motion` are already set. The caller frees motion->record with dynamics_record_free. Returns
   FF_NOCONV if there were too many steps. */
ff_status dynamics_motion_record(dynamics_motion *motion, const dynamics_inputs *inputs,
                                 double tolerance, size_t per_cycle, double delta, double rate);

/* The outputs from DYNAMICS_OUT_ATLAS_FREQUENCY to DYNAMICS_OUT_ATLAS_FLOQUET_MAX, one number per
   point of the atlas. */
typedef struct dynamics_atlas_columns {
    double *frequency, *rms, *stable, *branch, *floquet;
} dynamics_atlas_columns;

/* Returns 0 if out of memory. */
int dynamics_atlas_columns_open(dynamics_atlas_columns *columns, size_t points,
                                const ff_host *host);

/* Computes the Floquet multipliers, the eigenvalues of the monodromy, as complex pairs (re, im).
   Returns the largest modulus. */
double dynamics_motion_multipliers(const dynamics_motion *motion, double multipliers[4]);

/* Sets det_error by Abel's identity: det M = exp(-2 zeta t), where t is the time in which the
   damper acts. Clocks and monodromy are already set. */
void dynamics_motion_check_determinant(dynamics_motion *motion);

/* Sets energy_error from the energies at both ends, the work supplied and the energy that the
   damper took. */
void dynamics_motion_check_energy(dynamics_motion *motion, double start, double end, double work,
                                  double loss);

/* Writes the outputs from DYNAMICS_OUT_DAMPER_LOSS on: means over the motion shown. If a film is
   wired back, also reports the difference between supplied and dissipated power. */
ff_status dynamics_motion_put_powers(const dynamics_motion *motion,
                                     const dynamics_film_powers *film, const ff_host *host);

ff_status dynamics_motion_put(const dynamics_motion *motion, const dynamics_inputs *inputs,
                              const ff_host *host);

/* Refuses outputs of the back flanks if the motion uses no separate curves for them. */
ff_status dynamics_motion_check_back(const ff_host *host, const dynamics_inputs *inputs,
                                     const dynamics_excitation *excitation);

/* Writes the outputs of gears that float in the middle of the backlash: no motion and no force. */
ff_status dynamics_motion_put_floating(const dynamics_inputs *inputs,
                                       const dynamics_excitation *excitation, const ff_host *host);

#endif
