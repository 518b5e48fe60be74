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

typedef enum ff_branch { FF_BRANCH_LOWER, FF_BRANCH_UPPER } ff_branch;

typedef struct ff_settling {
    ff_branch branch;
    double T;         /* duration of a mesh cycle */
    size_t cycles;    /* at most; 0: by the damping */
    double tolerance; /* of the distance to the periodic motion */
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

/* FF_OK, FF_STOPPED, or FF_NOCONV: too many steps. The state of `o` is the settled one. */
ff_status ff_settle(ff_oscillator *o, const ff_mesh *mesh, const ff_settling *how,
                    ff_settled *result);

#endif
