/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a solver of the whole equation of motion promises: what is known of its errors, where the
   motion that its branch leads to repeats itself. */
#ifndef DYNAMICS_ERROR_ESTIMATE_H
#define DYNAMICS_ERROR_ESTIMATE_H

#include "inputs.h"
#include "settle.h"
#include "warm-start.h"

typedef struct dynamics_error_estimate {
    double error;   /* relative */
    double cost;    /* s */
    double longest; /* mesh cycle that it follows, rad of the natural frequency */
    int one_cycle;  /* it knows motions of one mesh cycle alone */
    dynamics_branch branch;
    const dynamics_warm_start *from; /* the motion of the neighbouring case; NULL: none */
    const char *reason;
} dynamics_error_estimate;

/* mesh: its zeta and damping are set. */
ff_status dynamics_error_estimate_put(const dynamics_error_estimate *estimate, const ff_host *host,
                                      const ff_array *in, const dynamics_inertia *inertia,
                                      dynamics_excitation excitation, ff_assessment *assessment);

#endif
