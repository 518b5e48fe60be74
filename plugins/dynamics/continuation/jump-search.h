/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether a motion is about to jump: whether within a small change of speed its branch has a fold,
   or the rule of the branch leads to another motion. */
#ifndef DYNAMICS_JUMP_SEARCH_H
#define DYNAMICS_JUMP_SEARCH_H

#include "../orbits/attractor.h"
#include "curve.h"

/* Finds the motion to which the user's rule leads at a speed; returns as dynamics_attract_branch.
 */
typedef ff_status dynamics_find_motion(const void *ctx, double lambda, dynamics_attractor *a);

typedef struct dynamics_jump_search {
    const dynamics_flow *flow;
    const ff_host *host;
    double width;               /* of ln(speed), to either side */
    double step;                /* as dynamics_continuation_range.step */
    dynamics_find_motion *find; /* NULL: the motion was given by name, so that there is no rule */
    const void *ctx;
} dynamics_jump_search;

/* What lies near a periodic motion. */
typedef struct dynamics_jump {
    int near;
    double lambda; /* of the fold, or of the speed at which the rule leads elsewhere */
    double rms;    /* of the motion, in units of excitation->length */
    double other;  /* rms of the other motion */
    int is_fold;
    int beside; /* the fold is one of the other motion; this one goes on */
} dynamics_jump;

ff_status dynamics_find_jump(const dynamics_jump_search *n, const dynamics_attractor *a,
                             dynamics_jump *jump);

/* Looks for a fold in which another motion ends that exists beside this one. */
ff_status dynamics_find_fold_of_another(const dynamics_jump_search *n, const dynamics_attractor *a,
                                        dynamics_jump *jump);

#endif
