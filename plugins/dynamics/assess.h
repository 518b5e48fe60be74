/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The assessment of a model that solves the whole equation of motion: its known error and cost hold
   where the motion that the branch leads to repeats itself. */
#ifndef DYNAMICS_ASSESS_H
#define DYNAMICS_ASSESS_H

#include "inputs.h"
#include "settle.h"
#include "warm-start.h"

typedef struct dynamics_assessment {
    double error; /* relative */
    double cost;  /* s */
    double
        longest;   /* the longest mesh cycle that the model follows, rad of the natural frequency */
    int one_cycle; /* the model knows no motions but those of one mesh cycle */
    dynamics_branch branch;
    const dynamics_warm_start *from; /* the motion of the neighbouring case; NULL: none */
    const char *reason;
} dynamics_assessment;

/* Of `excitation` only zeta and damping are set. */
ff_status dynamics_assess(const dynamics_assessment *estimate, const ff_host *host,
                          const ff_array *in, const dynamics_inertia *inertia,
                          dynamics_excitation excitation, ff_assessment *assessment);

#endif
