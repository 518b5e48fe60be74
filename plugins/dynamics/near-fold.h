/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether a motion is about to jump: a fold of its branch, or another motion that the branch's rule
   leads to, within a small change of speed. */
#ifndef FF_DYNAMICS_NEAR_FOLD_H
#define FF_DYNAMICS_NEAR_FOLD_H

#include "attractor.h"
#include "curve.h"

/* The motion that the user's rule leads to at a speed. FF_OK, or as ff_attract_branch. */
typedef ff_status ff_find_motion(const void *ctx, double lambda, ff_attractor *a);

typedef struct ff_nearness {
    const ff_flow *flow;
    const ff_host *host;
    double width;         /* of ln(speed), to either side */
    double step;          /* as ff_tracing.step */
    ff_find_motion *find; /* NULL: the motion has a name, and no rule leads elsewhere */
    const void *ctx;
} ff_nearness;

/* What lies near a periodic motion. */
typedef struct ff_jump {
    int near;
    double lambda; /* of the fold, or of the speed at which the rule leads elsewhere */
    double rms;    /* of the motion, and of the other one; units of mesh->length */
    double other;
    int is_fold;
    int beside; /* the fold is of the other motion; this one goes on */
} ff_jump;

ff_status ff_look_for_jump(const ff_nearness *n, const ff_attractor *a, ff_jump *jump);

/* Where there is none: a fold in which another motion ends, that lives beside this one. */
ff_status ff_look_for_birth(const ff_nearness *n, const ff_attractor *a, ff_jump *jump);

#endif
