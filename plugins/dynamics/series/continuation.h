/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Follows a branch of motions of one mesh cycle to a mesh frequency as a slow sweep of the speed
 * would: where the branch turns back at a fold the motion jumps, and integration in time tells
 * where to.
 */
#ifndef DYNAMICS_CONTINUATION_H
#define DYNAMICS_CONTINUATION_H

#include "harmonics.h"

#include <flankfilm/plugin.h>

typedef struct dynamics_continuation_request {
    const dynamics_excitation *excitation;
    const ff_host *host;
    int from_above;   /* 1: from 1.4 times the natural frequency down; 0: from 0.7 w up */
    double w;         /* mesh over natural frequency that is to be reached */
    size_t harmonics; /* of the series on the way */
} dynamics_continuation_request;

typedef struct dynamics_continuation_result {
    double *x; /* series at w with the request's harmonics; the caller frees it */
    size_t points, folds;
    int lost;        /* 1: the branch was lost, and x is the motion at w that never loses contact */
    const char *why; /* the reason for FF_NOCONV */
} dynamics_continuation_result;

ff_status dynamics_continuation_follow(const dynamics_continuation_request *request,
                                       dynamics_continuation_result *result);

/* A motion to start from: its series at mesh over natural frequency w. */
typedef struct dynamics_continuation_start {
    const double *x;
    size_t harmonics;
    double w;
} dynamics_continuation_start;

/* The same from that motion to the frequency of the request. */
ff_status dynamics_continuation_from(const dynamics_continuation_request *request,
                                     const dynamics_continuation_start *from,
                                     dynamics_continuation_result *result);

#endif
