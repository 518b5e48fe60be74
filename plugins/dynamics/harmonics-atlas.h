/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * An atlas by harmonic balance: the curves of motions of one mesh cycle that enter a range of mesh
 * frequencies at either end, or that never lose contact somewhere within it, and their stability. A
 * branch is a stretch of a curve between folds.
 */
#ifndef DYNAMICS_HARMONICS_ATLAS_H
#define DYNAMICS_HARMONICS_ATLAS_H

#include "excitation.h"
#include "motion.h"

typedef struct dynamics_harmonics_range {
    const dynamics_excitation *excitation;
    const ff_host *host;
    double low, high; /* mesh over natural frequency */
    size_t harmonics;
} dynamics_harmonics_range;

typedef struct dynamics_harmonics_point {
    double w, rms,
        floquet; /* w is mesh over natural frequency; largest modulus of the multipliers */
    int branch, stable;
} dynamics_harmonics_point;

typedef struct dynamics_harmonics_event {
    double w;
    int branch;
} dynamics_harmonics_event;

typedef struct dynamics_harmonics_atlas {
    size_t points, folds, doublings;
    dynamics_harmonics_point *point;
    dynamics_harmonics_event *fold, *doubling;
    int branches;
    const char *ended; /* says why a curve ended within the range; NULL: none did */
} dynamics_harmonics_atlas;

/* FF_OK, FF_STOPPED, FF_NOMEM. */
ff_status dynamics_harmonics_atlas_build(const dynamics_harmonics_range *range,
                                         dynamics_harmonics_atlas *atlas);
void dynamics_harmonics_atlas_free(dynamics_harmonics_atlas *atlas);

/* Gives the outputs from DYNAMICS_OUT_ATLAS_FREQUENCY on; `frequency` is the natural one, Hz. */
ff_status dynamics_harmonics_atlas_put(const dynamics_harmonics_atlas *atlas,
                                       const dynamics_excitation *excitation, double frequency,
                                       const ff_host *host);

#endif
