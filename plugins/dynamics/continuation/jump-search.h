/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds out whether a motion is about to jump: whether within a small change of speed its branch
 * has a fold, or the branch rule leads to another motion. */
#ifndef DYNAMICS_JUMP_SEARCH_H
#define DYNAMICS_JUMP_SEARCH_H

#include "../orbits/attractor.h"
#include "curve.h"

/* Finds the motion to which the user's branch rule leads at a speed. Returns the status of
 * dynamics_attract_branch. */
typedef ff_status dynamics_find_motion(const void *ctx, double lambda, dynamics_attractor *a);

typedef struct dynamics_jump_search {
    const dynamics_flow *flow;
    const ff_host *host;
    double width;               /* of ln(speed), to either side */
    double step;                /* as dynamics_continuation_range.step */
    dynamics_find_motion *find; /* NULL: the motion was given by name, without a rule */
    const void *ctx;
} dynamics_jump_search;

/* A jump near a periodic motion. */
typedef struct dynamics_jump {
    int near;
    double lambda; /* lambda of the fold, or of the speed at which the rule leads elsewhere */
    double rms;    /* rms of the motion, in units of excitation->length */
    double other;  /* rms of the other motion */
    int is_fold;
    int beside; /* 1: the fold ends another motion; this one continues */
} dynamics_jump;

ff_status dynamics_find_jump(const dynamics_jump_search *n, const dynamics_attractor *a,
                             dynamics_jump *jump);

/* Looks for a fold that ends another motion which exists beside this one. */
ff_status dynamics_find_fold_of_another(const dynamics_jump_search *n, const dynamics_attractor *a,
                                        dynamics_jump *jump);

#endif
