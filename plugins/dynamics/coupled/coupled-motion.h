/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steady motion of a gear pair on elastic bearings: how it is found, its stability, and its
   outputs. */
#ifndef DYNAMICS_COUPLED_MOTION_H
#define DYNAMICS_COUPLED_MOTION_H

#include "../excitation/inputs.h"
#include "../oscillator/motion.h"
#include "../oscillator/settle.h"
#include "coupled-run.h"

/* These outputs follow the outputs from DYNAMICS_OUT_PHASE to DYNAMICS_OUT_MULTIPLIERS. */
enum {
    DYNAMICS_CO_CENTRE_DISTANCE = DYNAMICS_OUT_MULTIPLIERS + 1,
    DYNAMICS_CO_PRESSURE_ANGLE,
    DYNAMICS_CO_BACKLASH,
    DYNAMICS_CO_CONTACT_RATIO,
    DYNAMICS_CO_DISPLACEMENT,
    DYNAMICS_CO_BEARING_FORCE,
    DYNAMICS_CO_LANDING_TIME,
    DYNAMICS_CO_LANDING_SPEED,
    DYNAMICS_COUPLED_OUTPUT_COUNT
};

extern const ff_port dynamics_coupled_outputs[DYNAMICS_COUPLED_OUTPUT_COUNT];

typedef struct dynamics_coupled_motion {
    dynamics_settled settled; /* its members delta and rate are not set; `state` contains all
                                 coordinates */
    size_t cycles;            /* number of cycles that the outputs show */
    double T;                 /* duration of a mesh cycle */
    double from; /* frequency of a motion to start from, over the natural frequency; 0: none */
    double state[DYNAMICS_TAKEN]; /* state at phase 0: first of the motion to start from, then of
                                     the motion found */
    double monodromy[DYNAMICS_TAKEN * DYNAMICS_TAKEN];
    double energy_error, parted, back;
    dynamics_coupled_record record;
} dynamics_coupled_motion;

/* Finds the steady motion of a branch by shooting, or by a slow speed sweep and settling if
   how->cycles is given. T and the start of `motion` are already set. Returns FF_OK, FF_STOPPED,
   FF_NOMEM, or FF_NOCONV for too many steps. */
ff_status dynamics_coupled_settle(dynamics_coupled_run *run, const dynamics_coupled *pair,
                                  const dynamics_settling *how, dynamics_coupled_motion *motion);

/* Records the shown cycles, the cycles of one more engagement, and the monodromy. The caller frees
   motion->record.samples. */
ff_status dynamics_coupled_motion_record(dynamics_coupled_motion *motion,
                                         const dynamics_coupled *pair,
                                         const dynamics_inputs *inputs, double tolerance,
                                         size_t per_cycle, const ff_host *host);

ff_status dynamics_coupled_put(const dynamics_coupled_motion *motion, const dynamics_coupled *pair,
                               const dynamics_inputs *inputs, const ff_host *host);

#endif
