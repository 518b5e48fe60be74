/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the long-term motion from a start: periodic, aperiodic, or unbounded. */
#ifndef DYNAMICS_ATTRACTOR_H
#define DYNAMICS_ATTRACTOR_H

#include "../oscillator/settle.h"
#include "orbit.h"

#include <flankfilm/plugin.h>

typedef struct dynamics_attractor {
    int period;           /* mesh cycles, DYNAMICS_APERIODIC or DYNAMICS_UNBOUNDED */
    dynamics_orbit orbit; /* of a periodic motion */
    double x[2];          /* last state */
    double growth;        /* of an aperiodic motion: the Lyapunov exponent per mesh cycle */
    size_t cycles;        /* integrated so far */
    int ends;             /* number of branches that ended while the speed changed */
    double ended;         /* lambda of the first of these ends */
} dynamics_attractor;

typedef struct dynamics_search {
    double lambda;
    int max_period;
    size_t cycles; /* most mesh cycles for settling */
    int growth;    /* 1: measure the growth of a motion that does not settle */
} dynamics_search;

/* Follows the motion from a->x until Newton's method finds the periodic motion nearby. 0: the flow
 * needs too many steps. */
int dynamics_attract(const dynamics_flow *flow, const dynamics_search *search,
                     dynamics_attractor *a);

/* Finds the motion of the lower or upper branch: the stable motion without separation, or else what
   the speed leads to when it rises from below; what it leads to when it falls from above. Branches
   are followed to their ends by Newton's method; there the motion settles anew. With little or no
   damping no motion settles: then that of a higher damping is followed down to the given one, and
   when this fails the period is DYNAMICS_APERIODIC. FF_OK, FF_STOPPED or FF_NOCONV. */
ff_status dynamics_attract_branch(const dynamics_flow *flow, dynamics_branch branch,
                                  const dynamics_search *search, const ff_host *host,
                                  dynamics_attractor *a);

/* Finds the motion into which `from` turns when the speed, and the gear pair, slowly become the
   present ones. `from` has its period, lambda and x set; a period below 1 means that it did not
   repeat itself. */
ff_status dynamics_attract_from(const dynamics_flow *flow, const dynamics_orbit *from,
                                const dynamics_search *search, const ff_host *host,
                                dynamics_attractor *a);

#endif
