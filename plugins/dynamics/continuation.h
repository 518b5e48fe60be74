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

/* The same branch point by point, without jumps, in the direction of the request. */
typedef struct dynamics_continuation dynamics_continuation;

typedef struct dynamics_continuation_point {
    const double *x; /* series, until the next step */
    double ln_w;
    double slope, length; /* derivative of ln w by arc length; length of the step that led here */
} dynamics_continuation_point;

dynamics_continuation *
dynamics_continuation_new(const dynamics_continuation_request *request); /* NULL: out of memory */
void dynamics_continuation_free(dynamics_continuation *path);

/* Finds a motion at w, or near it on the way, and the direction of its branch. */
ff_status dynamics_continuation_begin(dynamics_continuation *path, double w,
                                      dynamics_continuation_result *result);
/* The same from the motion at w that never loses contact; 0: there is none. */
int dynamics_continuation_begin_in_contact(dynamics_continuation *path, double w);
dynamics_continuation_point dynamics_continuation_here(const dynamics_continuation *path);
int dynamics_continuation_step(dynamics_continuation *path); /* 0: no step is short enough */

/* Solves for the motion at a frequency from a guess, which it replaces; 0: none is near. */
int dynamics_continuation_solve(dynamics_continuation *path, double ln_w, double *x);

#endif
