/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Follows a branch of motions of one mesh cycle to a mesh frequency, by arc length, as a slow sweep
 * of the speed would: where the branch turns back at a fold the motion jumps, and a few mesh cycles
 * integrated in time say where to.
 */
#ifndef DYNAMICS_BALANCE_PATH_H
#define DYNAMICS_BALANCE_PATH_H

#include "balance.h"

#include <flankfilm/plugin.h>

typedef struct dynamics_route {
    const dynamics_mesh *mesh;
    const ff_host *host;
    int from_above;   /* from 1.4 times the natural frequency down; else from 0.7 w up */
    double w;         /* where to: mesh over natural frequency */
    size_t harmonics; /* of the series on the way */
} dynamics_route;

typedef struct dynamics_arrival {
    double *x; /* series at w with the route's harmonics; the caller frees it */
    size_t points, folds;
    int astray;      /* the branch could not be followed; x never loses contact and lies at w */
    const char *why; /* of FF_NOCONV */
} dynamics_arrival;

ff_status dynamics_balance_follow(const dynamics_route *route, dynamics_arrival *arrival);

/* A motion to start from: a series at mesh over natural frequency w. */
typedef struct dynamics_departure {
    const double *x;
    size_t harmonics;
    double w;
} dynamics_departure;

/* The same from that motion to the end of the route. */
ff_status dynamics_balance_continue(const dynamics_route *route, const dynamics_departure *from,
                                    dynamics_arrival *arrival);

/* The same branch point by point, without jumps, in the direction of the route. */
typedef struct dynamics_path dynamics_path;

typedef struct dynamics_path_point {
    const double *x; /* series, until the next step */
    double ln_w;
    double slope, length; /* of ln w along the branch; of the step that led here */
} dynamics_path_point;

dynamics_path *dynamics_path_new(const dynamics_route *route); /* NULL: out of memory */
void dynamics_path_free(dynamics_path *path);

/* Finds a motion at w, or near it on the way, and the direction of its branch. */
ff_status dynamics_path_begin(dynamics_path *path, double w, dynamics_arrival *arrival);
/* The same from the motion at w that never loses contact; 0: there is none. */
int dynamics_path_begin_in_contact(dynamics_path *path, double w);
dynamics_path_point dynamics_path_here(const dynamics_path *path);
int dynamics_path_step(dynamics_path *path); /* 0: no step is short enough */

/* Solves for the motion at a frequency from a guess, which it replaces; 0: there is none near. */
int dynamics_path_solve(dynamics_path *path, double ln_w, double *x);

#endif
