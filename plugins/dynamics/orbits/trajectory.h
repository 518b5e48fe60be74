/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Observes a flow: sums up moments, energies and times of its motion, and takes samples. */
#ifndef DYNAMICS_TRAJECTORY_H
#define DYNAMICS_TRAJECTORY_H

#include "../oscillator/motion.h"
#include "flow.h"

typedef struct dynamics_trajectory {
    double origin;      /* of s in the moments */
    double sum, square; /* integrals over time of s - origin and of its square */
    double loss, work;  /* energy that damper and films took and that the excitation brought in */
    double films;       /* what the films took of it */
    double drag;        /* what friction and rolling took from the vibration */
    double thickness;   /* what the loaded film brought in, of the work */
    double energy;      /* of the state at the end */
    double start;       /* of the state at the start */
    dynamics_clocks clocks;
    const dynamics_radau *radau; /* of the flow */
    dynamics_record *record;
    size_t next;              /* number of the next sample of the cycle */
    int begun, side, pressed; /* of the last step */
} dynamics_trajectory;

/* An observer of a flow that sums up the moments of s alone. */
void dynamics_trajectory_observe_moments(void *trace, const dynamics_step *step);

/* Records the motion from x as dynamics_motion_record does, but to round-off. `motion` has
   excitation, period, cycles and T set. A periodic motion begins anew at x after each period. */
ff_status dynamics_trajectory_record(const dynamics_flow *flow, const dynamics_inputs *inputs,
                                     size_t per_cycle, const double x[2], dynamics_motion *motion);

#endif
