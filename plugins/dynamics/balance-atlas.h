/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The curves of motions of one mesh cycle that come in from both ends of a range of mesh
 * frequencies, or that never lose contact somewhere in it, with their stability. A branch is a
 * stretch of a curve between folds.
 */
#ifndef DYNAMICS_BALANCE_ATLAS_H
#define DYNAMICS_BALANCE_ATLAS_H

#include "mesh.h"
#include "motion.h"

typedef struct dynamics_balance_range {
    const dynamics_mesh *mesh;
    const ff_host *host;
    double low, high; /* mesh over natural frequency */
    size_t harmonics;
} dynamics_balance_range;

typedef struct dynamics_balance_point {
    double w, rms, floquet;
    int branch, stable;
} dynamics_balance_point;

typedef struct dynamics_balance_event {
    double w;
    int branch;
} dynamics_balance_event;

typedef struct dynamics_balance_atlas {
    size_t points, folds, doublings;
    dynamics_balance_point *point;
    dynamics_balance_event *fold, *doubling;
    int branches;
    const char *ended; /* why a curve ended within the range; NULL: none did */
} dynamics_balance_atlas;

/* FF_OK, FF_STOPPED, FF_NOMEM. */
ff_status dynamics_balance_atlas_build(const dynamics_balance_range *range,
                                       dynamics_balance_atlas *atlas);
void dynamics_balance_atlas_free(dynamics_balance_atlas *atlas);

/* Gives the outputs from DYNAMICS_OUT_ATLAS_FREQUENCY on; `frequency` is the natural one, Hz. */
ff_status dynamics_balance_atlas_put(const dynamics_balance_atlas *atlas, const dynamics_mesh *mesh,
                                     double frequency, const ff_host *host);

#endif
