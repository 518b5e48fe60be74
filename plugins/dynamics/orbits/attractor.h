/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the motion that develops from a start state: periodic, aperiodic, or unbounded. */
#ifndef DYNAMICS_ATTRACTOR_H
#define DYNAMICS_ATTRACTOR_H

#include "../oscillator/settle.h"
#include "orbit.h"

#include <flankfilm/plugin.h>

typedef struct dynamics_attractor {
    int period;           /* in mesh cycles, or DYNAMICS_APERIODIC or DYNAMICS_UNBOUNDED */
    dynamics_orbit orbit; /* set if the motion is periodic */
    double x[2];          /* last state */
    double growth;        /* Lyapunov exponent per mesh cycle, if the motion is aperiodic */
    size_t cycles;        /* number of cycles integrated so far */
    int ends;             /* number of branches that ended while the speed changed */
    double ended;         /* lambda at the first of these ends */
} dynamics_attractor;

typedef struct dynamics_search {
    double lambda;
    int max_period;
    size_t cycles; /* most mesh cycles for settling */
    int growth;    /* 1: the growth of disturbances is measured if the motion does not settle */
} dynamics_search;

/* Integrates the motion from a->x until Newton's method finds a periodic motion nearby. Returns 0
   if this needs too many steps. */
int dynamics_attract(const dynamics_flow *flow, const dynamics_search *search,
                     dynamics_attractor *a);

/* Finds the motion of the lower or upper branch. Lower: the stable motion without separation; if
   there is none, the motion to which a slow rise of the speed leads. Upper: the motion to which a
   slow fall of the speed leads. Branches are followed to their ends by Newton's method; there the
   motion settles again. With little or no damping no motion settles. The motion at a higher damping
   ratio is then continued down to the given damping ratio; if this fails, the period is
   DYNAMICS_APERIODIC. Returns FF_OK, FF_STOPPED or FF_NOCONV. */
ff_status dynamics_attract_branch(const dynamics_flow *flow, dynamics_branch branch,
                                  const dynamics_search *search, const ff_host *host,
                                  dynamics_attractor *a);

/* Finds the motion to which `from` leads when speed and gear pair slowly change to the current
   speed and pair. The members period, lambda and x of `from` are set; a period below 1 means that
   the motion did not repeat. */
ff_status dynamics_attract_from(const dynamics_flow *flow, const dynamics_orbit *from,
                                const dynamics_search *search, const ff_host *host,
                                dynamics_attractor *a);

#endif
