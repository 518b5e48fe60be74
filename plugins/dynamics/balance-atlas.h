/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The curves of motions of one mesh cycle that come in from both ends of a range of mesh
 * frequencies, or that never lose contact somewhere in it, with their stability. A branch is a
 * stretch of a curve between folds.
 */
#ifndef FF_DYNAMICS_BALANCE_ATLAS_H
#define FF_DYNAMICS_BALANCE_ATLAS_H

#include "mesh.h"
#include "motion.h"

typedef struct ff_balance_range {
    const ff_mesh *mesh;
    const ff_host *host;
    double low, high; /* mesh over natural frequency */
    size_t harmonics;
} ff_balance_range;

typedef struct ff_balance_point {
    double w, rms, floquet;
    int branch, stable;
} ff_balance_point;

typedef struct ff_balance_event {
    double w;
    int branch;
} ff_balance_event;

typedef struct ff_balance_atlas {
    size_t points, folds, doublings;
    ff_balance_point *point;
    ff_balance_event *fold, *doubling;
    int branches;
    const char *ended; /* why a curve ended within the range; NULL: none did */
} ff_balance_atlas;

/* FF_OK, FF_STOPPED, FF_NOMEM. */
ff_status ff_balance_atlas_build(const ff_balance_range *range, ff_balance_atlas *atlas);
void ff_balance_atlas_free(ff_balance_atlas *atlas);

/* Gives the outputs from FF_OUT_ATLAS_FREQUENCY on; `frequency` is the natural one, Hz. */
ff_status ff_balance_atlas_put(const ff_balance_atlas *atlas, const ff_mesh *mesh, double frequency,
                               const ff_host *host);

#endif
