/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Quality lines of a motion that the return map found: whether it repeats itself, and how exactly.
 */
#ifndef DYNAMICS_PERIODICITY_H
#define DYNAMICS_PERIODICITY_H

#include "attractor.h"
#include "motion.h"

/* Growth of a disturbance per mesh cycle, in logarithms, above which a motion is chaotic. */
extern const double dynamics_chaotic_growth;

/* `max_period`: the longest period, in mesh cycles, that was looked for. */
void dynamics_periodicity_report(const dynamics_attractor *a, const dynamics_motion *motion,
                                 int max_period, const ff_host *host);

#endif
