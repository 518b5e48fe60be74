/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds out whether a motion is about to jump: whether, within a small change of speed, its branch
   has a fold or the branch rule leads to another motion. */
#ifndef DYNAMICS_JUMP_SEARCH_H
#define DYNAMICS_JUMP_SEARCH_H

#include "../orbits/attractor.h"
#include "curve.h"

/* Finds the motion at a speed by the user's branch rule. Returns the status of
   dynamics_attract_branch. */
typedef ff_status dynamics_find_motion(const void *ctx, double lambda, dynamics_attractor *a);

typedef struct dynamics_jump_search {
    const dynamics_flow *flow;
    const ff_host *host;
    double width;               /* half width of the range, in ln(speed) */
    double step;                /* see dynamics_continuation_range.step */
    dynamics_find_motion *find; /* NULL: the user named the branch, and no rule applies */
    const void *ctx;
} dynamics_jump_search;

/* A jump near a periodic motion. */
typedef struct dynamics_jump {
    int near;
    double lambda; /* lambda of the fold, or of the speed where the rule leads to another motion */
    double rms;    /* rms of the motion, in units of excitation->length */
    double other;  /* rms of the other motion, in the same units */
    int is_fold;
    int beside; /* 1: the other motion ends at the fold and the given motion continues */
} dynamics_jump;

ff_status dynamics_find_jump(const dynamics_jump_search *n, const dynamics_attractor *a,
                             dynamics_jump *jump);

/* Looks for a fold at which another motion ends; that motion coexists with the given motion. */
ff_status dynamics_find_fold_of_another(const dynamics_jump_search *n, const dynamics_attractor *a,
                                        dynamics_jump *jump);

#endif
