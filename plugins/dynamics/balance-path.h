/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Follows a branch of motions of one mesh cycle to a mesh frequency, by arc length, as a slow sweep
 * of the speed would: where the branch turns back at a fold the motion jumps, and a few mesh cycles
 * integrated in time say where to.
 */
#ifndef FF_DYNAMICS_BALANCE_PATH_H
#define FF_DYNAMICS_BALANCE_PATH_H

#include "balance.h"

#include <flankfilm/plugin.h>

typedef struct ff_route {
    const ff_mesh *mesh;
    const ff_host *host;
    int from_above;   /* from 1.4 times the natural frequency down; else from 0.7 w up */
    double w;         /* where to: mesh over natural frequency */
    size_t harmonics; /* of the series on the way */
} ff_route;

typedef struct ff_arrival {
    double *x; /* series at w with the route's harmonics; the caller frees it */
    size_t points, folds;
    int astray;      /* the branch could not be followed; x never loses contact and lies at w */
    const char *why; /* of FF_NOCONV */
} ff_arrival;

ff_status ff_balance_follow(const ff_route *route, ff_arrival *arrival);

/* A motion to start from: a series at mesh over natural frequency w. */
typedef struct ff_departure {
    const double *x;
    size_t harmonics;
    double w;
} ff_departure;

/* The same from that motion to the end of the route. */
ff_status ff_balance_continue(const ff_route *route, const ff_departure *from, ff_arrival *arrival);

/* The same branch point by point, without jumps, in the direction of the route. */
typedef struct ff_path ff_path;

typedef struct ff_path_point {
    const double *x; /* series, until the next step */
    double ln_w;
    double slope, length; /* of ln w along the branch; of the step that led here */
} ff_path_point;

ff_path *ff_path_new(const ff_route *route); /* NULL: out of memory */
void ff_path_free(ff_path *path);

/* Finds a motion at w, or near it on the way, and the direction of its branch. */
ff_status ff_path_begin(ff_path *path, double w, ff_arrival *arrival);
/* The same from the motion at w that never loses contact; 0: there is none. */
int ff_path_begin_in_contact(ff_path *path, double w);
ff_path_point ff_path_here(const ff_path *path);
int ff_path_step(ff_path *path); /* 0: no step is short enough */

/* Solves for the motion at a frequency from a guess, which it replaces; 0: there is none near. */
int ff_path_solve(ff_path *path, double ln_w, double *x);

#endif
