/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The motion that a case of a chain passes to the next case, as in a slow sweep of the speed. */
#ifndef DYNAMICS_WARM_START_H
#define DYNAMICS_WARM_START_H

#include "excitation.h"

#include <flankfilm/plugin.h>

typedef struct dynamics_warm_start {
    char mark[16];
    double mesh_frequency; /* Hz; 0: there is no motion */
    double delta, rate;    /* m, m/s: s - e and its rate at phase 0, before a jump there */
    int64_t period;        /* mesh cycles; below 1: the motion is not periodic */
} dynamics_warm_start;

/* Implements `carry` of a model: sets `taken` to the motion of the neighbouring case, or to none if
   the bytes have another format, and writes the model's own motion `left` to `to`. */
ff_status dynamics_warm_start_carry(dynamics_warm_start *taken, const ff_state_bytes *from,
                                    const dynamics_warm_start *left, ff_state_bytes *to);

/* Converts a state from the units of the excitation to SI, and back. */
dynamics_warm_start dynamics_warm_start_motion(const dynamics_excitation *excitation,
                                               double mesh_frequency, int period, double delta,
                                               double rate);
void dynamics_warm_start_state(const dynamics_warm_start *warm_start,
                               const dynamics_excitation *excitation, double x[2]);

#endif
