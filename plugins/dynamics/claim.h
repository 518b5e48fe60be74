/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a solver of the whole equation of motion promises: what is known of its errors, where the
   motion that its branch leads to repeats itself. */
#ifndef DYNAMICS_CLAIM_H
#define DYNAMICS_CLAIM_H

#include "carried.h"
#include "inputs.h"
#include "settle.h"

typedef struct dynamics_claim {
    double error;   /* relative */
    double cost;    /* s */
    double longest; /* mesh cycle that it follows, rad of the natural frequency */
    int one_cycle;  /* it knows motions of one mesh cycle alone */
    dynamics_branch branch;
    const dynamics_carried *from; /* the motion of the neighbouring case; NULL: none */
    const char *reason;
} dynamics_claim;

/* mesh: its zeta and damping are set. */
ff_status dynamics_claim_put(const dynamics_claim *claim, const ff_host *host, const ff_array *in,
                             const dynamics_inertia *inertia, dynamics_mesh mesh,
                             ff_assessment *assessment);

#endif
