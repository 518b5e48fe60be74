/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a start state to the steady motion of a branch, and how well it has settled. */
#ifndef FF_DYNAMICS_SETTLE_H
#define FF_DYNAMICS_SETTLE_H

#include "oscillator.h"

#include <flankfilm/plugin.h>

enum {
    FF_LONGEST_PERIOD = 8, /* mesh cycles that are told from an aperiodic motion */
    FF_APERIODIC = 0,
    FF_UNBOUNDED = -1
};

/* Lower: the motion without separation where there is a stable one, else what a sweep from below
   reaches. Upper: what a sweep from above reaches. */
typedef enum ff_branch { FF_BRANCH_LOWER, FF_BRANCH_UPPER } ff_branch;

typedef struct ff_settling {
    ff_branch branch;
    double T;              /* duration of a mesh cycle */
    size_t cycles;         /* at most; 0: by the damping */
    double tolerance;      /* of the distance to the periodic motion */
    double step_tolerance; /* error of one integration step */
    double from;           /* mesh over natural frequency of a motion to start from; 0: none */
    double start[2];       /* its state */
    const ff_host *host;
} ff_settling;

typedef struct ff_settled {
    int period;         /* mesh cycles, FF_APERIODIC or FF_UNBOUNDED */
    int within;         /* the tolerance was met */
    size_t cycles;      /* used, without those of the sweep */
    size_t limit;       /* cycles that were allowed */
    double distance;    /* estimated, to the periodic motion, in units of mesh->length */
    double delta, rate; /* state at phase 0, before the node */
} ff_settled;

/* The sweep that leads to a branch, for whoever integrates in another way: where it starts for a
   mesh frequency (both over the natural frequency), the share by which the frequency changes per
   cycle, the cycles at the start, and the static deflection there. */
double ff_sweep_from(ff_branch branch, double frequency);
double ff_sweep_rate(const ff_mesh *mesh, double frequency);
size_t ff_sweep_start_cycles(const ff_mesh *mesh, double T);
double ff_rest_deflection(const ff_mesh *mesh);

/* Most cycles that a motion may take to settle to a tolerance. */
size_t ff_settle_limit(const ff_mesh *mesh, double T, double tolerance);

/* FF_OK, FF_STOPPED, or FF_NOCONV: too many steps. The state of `o` is the settled one. */
ff_status ff_settle(ff_oscillator *o, const ff_mesh *mesh, const ff_settling *how,
                    ff_settled *result);

#endif
