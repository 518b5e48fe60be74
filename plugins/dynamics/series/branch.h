/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the series of the motion of period 1 on a branch. First the motion on the branch is found
   by the return map and followed to the requested speed (attractor.h). From this motion as a guess,
   Newton's method finds the series, whether stable or not. */
#ifndef DYNAMICS_BRANCH_H
#define DYNAMICS_BRANCH_H

#include "../oscillator/settle.h"
#include "harmonics.h"

#include <flankfilm/plugin.h>

/* A motion to start from: its series x, and its ratio w of mesh frequency to natural frequency. */
typedef struct dynamics_branch_start {
    const double *x; /* NULL: none */
    size_t harmonics;
    double w;
} dynamics_branch_start;

typedef struct dynamics_branch_request {
    const dynamics_excitation *excitation;
    const ff_host *host;
    dynamics_branch branch;
    double w;         /* mesh frequency over natural frequency */
    size_t harmonics; /* number of harmonics of the series */
    dynamics_branch_start from;
} dynamics_branch_request;

typedef struct dynamics_branch_result {
    double *x;       /* series at request->w with request->harmonics harmonics; the caller frees
                        it */
    int ends;        /* number of branch ends met before the requested speed */
    int lost;        /* 1: the branch was lost, and x is the motion without contact loss */
    const char *why; /* reason if the status is FF_NOCONV */
} dynamics_branch_result;

ff_status dynamics_branch_series(const dynamics_branch_request *request,
                                 dynamics_branch_result *result);

#endif
