/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a solver of the whole equation of motion says of itself, which needs no look at the motion.
 */
#ifndef FF_DYNAMICS_CLAIM_H
#define FF_DYNAMICS_CLAIM_H

#include "inputs.h"

typedef struct ff_claim {
    double error;   /* relative */
    double cost;    /* s */
    double longest; /* mesh cycle that it follows, rad of the natural frequency */
    const char *reason;
} ff_claim;

/* mesh: its zeta and damping are set. */
ff_status ff_claim_put(const ff_claim *claim, const ff_host *host, const ff_array *in,
                       const ff_inertia *inertia, ff_mesh mesh, ff_assessment *assessment);

#endif
