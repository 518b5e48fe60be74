/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steady motion of a coupled pair: how it is reached, how stable it is, and the outputs. */
#ifndef FF_DYNAMICS_COUPLED_MOTION_H
#define FF_DYNAMICS_COUPLED_MOTION_H

#include "coupled-run.h"
#include "inputs.h"
#include "motion.h"
#include "settle.h"

/* Behind FF_OUT_PHASE to FF_OUT_MULTIPLIERS. */
enum {
    FF_CO_CENTRE_DISTANCE = FF_OUT_MULTIPLIERS + 1,
    FF_CO_PRESSURE_ANGLE,
    FF_CO_BACKLASH,
    FF_CO_CONTACT_RATIO,
    FF_CO_DISPLACEMENT,
    FF_CO_BEARING_FORCE,
    FF_COUPLED_OUTPUT_COUNT
};

extern const ff_port ff_coupled_outputs[FF_COUPLED_OUTPUT_COUNT];

typedef struct ff_coupled_motion {
    int period;                 /* mesh cycles, FF_APERIODIC or FF_UNBOUNDED */
    int within;                 /* the tolerance was met */
    size_t used, limit, cycles; /* to settle; shown */
    double distance, T;
    double state[FF_TAKEN]; /* at phase 0 */
    double monodromy[FF_TAKEN * FF_TAKEN];
    double energy_error, parted, back;
    ff_coupled_record record;
} ff_coupled_motion;

/* FF_OK, FF_STOPPED, FF_NOCONV: too many steps, FF_NOMEM. `motion` has T set. */
ff_status ff_coupled_settle(ff_coupled_run *run, const ff_coupled *pair, const ff_settling *how,
                            ff_coupled_motion *motion);

/* Records the cycles that are shown and a tooth's engagement more, and the monodromy. The caller
   frees motion->record.samples. */
ff_status ff_coupled_motion_record(ff_coupled_motion *motion, const ff_coupled *pair,
                                   const ff_inputs *inputs, double tolerance, size_t per_cycle,
                                   const ff_host *host);

/* Multipliers (re, im), and the largest modulus. */
ff_status ff_coupled_multipliers(const ff_coupled_motion *motion, double *multipliers,
                                 double *largest);

ff_status ff_coupled_put(const ff_coupled_motion *motion, const ff_coupled *pair,
                         const ff_inputs *inputs, const ff_host *host);

#endif
