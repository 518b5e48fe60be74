/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The quality lines of a motion that the return map found: whether it repeats itself, how exactly.
 */
#ifndef DYNAMICS_PERIODICITY_H
#define DYNAMICS_PERIODICITY_H

#include "../oscillator/motion.h"
#include "attractor.h"

/* A motion is chaotic when the logarithm of a disturbance grows by more than this per mesh cycle.
 */
extern const double dynamics_chaotic_growth;

/* `max_period` is the longest period, in mesh cycles, that was looked for. */
void dynamics_periodicity_report(const dynamics_attractor *a, const dynamics_motion *motion,
                                 int max_period, const ff_host *host);

#endif
