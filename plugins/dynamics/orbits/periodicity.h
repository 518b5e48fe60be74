/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Quality lines of a motion found with the return map: whether it is periodic, and how
   accurately. */
#ifndef DYNAMICS_PERIODICITY_H
#define DYNAMICS_PERIODICITY_H

#include "../oscillator/motion.h"
#include "attractor.h"

/* A motion is chaotic if the logarithm of a disturbance increases by more than this value per mesh
   cycle. */
extern const double dynamics_chaotic_growth;

/* `max_period` is the longest period that was tried, in mesh cycles. */
void dynamics_periodicity_report(const dynamics_attractor *a, const dynamics_motion *motion,
                                 int max_period, const ff_host *host);

#endif
