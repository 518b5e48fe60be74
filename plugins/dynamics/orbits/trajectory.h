/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Observers of a flow. They sum moments, energies and times, and take samples. */
#ifndef DYNAMICS_TRAJECTORY_H
#define DYNAMICS_TRAJECTORY_H

#include "../oscillator/motion.h"
#include "flow.h"

typedef struct dynamics_trajectory {
    double origin;      /* origin of s in the moments */
    double sum, square; /* integrals over time of (s - origin) and its square */
    double loss, work;  /* energy taken by damper and films; energy supplied by the excitation */
    double films;       /* part of `loss` taken by the films */
    double drag;        /* energy taken from the vibration by friction and rolling */
    double thickness;   /* part of `work` supplied by the changing thickness of the loaded film */
    double energy;      /* energy of the state at the end */
    double start;       /* energy of the state at the start */
    dynamics_clocks clocks;
    const dynamics_radau *radau; /* Radau nodes of the flow */
    dynamics_record *record;
    size_t next;                 /* index of the next sample in the cycle */
    int begun, side, pressed;    /* whether a step has been observed; contact in the last step */
    const dynamics_piece *track; /* first piece of the track of the last step */
} dynamics_trajectory;

/* Observer that sums the moments of s only. */
void dynamics_trajectory_observe_moments(void *trace, const dynamics_step *step);

/* Records the motion from x, as dynamics_motion_record does, but with an accuracy of round-off.
   excitation, period, cycles and T of `motion` are already set. A periodic motion restarts at x
   after each period. */
ff_status dynamics_trajectory_record(const dynamics_flow *flow, const dynamics_inputs *inputs,
                                     size_t per_cycle, const double x[2], dynamics_motion *motion);

#endif
