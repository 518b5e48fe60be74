/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether a motion is about to jump: a fold of its branch, or another motion that the branch's rule
   leads to, within a small change of speed. */
#ifndef DYNAMICS_NEAR_FOLD_H
#define DYNAMICS_NEAR_FOLD_H

#include "attractor.h"
#include "curve.h"

/* The motion that the user's rule leads to at a speed. FF_OK, or as dynamics_attract_branch. */
typedef ff_status dynamics_find_motion(const void *ctx, double lambda, dynamics_attractor *a);

typedef struct dynamics_jump_search {
    const dynamics_flow *flow;
    const ff_host *host;
    double width;               /* of ln(speed), to either side */
    double step;                /* as dynamics_continuation_range.step */
    dynamics_find_motion *find; /* NULL: the motion has a name, and no rule leads elsewhere */
    const void *ctx;
} dynamics_jump_search;

/* What lies near a periodic motion. */
typedef struct dynamics_jump {
    int near;
    double lambda; /* of the fold, or of the speed at which the rule leads elsewhere */
    double rms;    /* of the motion, and of the other one; units of mesh->length */
    double other;
    int is_fold;
    int beside; /* the fold is of the other motion; this one goes on */
} dynamics_jump;

ff_status dynamics_find_jump(const dynamics_jump_search *n, const dynamics_attractor *a,
                             dynamics_jump *jump);

/* Where there is none: a fold in which another motion ends, that lives beside this one. */
ff_status dynamics_find_fold_of_another(const dynamics_jump_search *n, const dynamics_attractor *a,
                                        dynamics_jump *jump);

#endif
