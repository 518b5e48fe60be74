/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Steps along a branch of series by pseudo-arclength continuation (Keller 1977): predicts along the
 * tangent and corrects by Newton's method across it. For continuation.c alone.
 */
#ifndef DYNAMICS_BRANCH_PATH_H
#define DYNAMICS_BRANCH_PATH_H

#include "continuation.h"

#include <lapacke.h>

typedef struct dynamics_branch_path {
    const dynamics_continuation_request *request;
    dynamics_harmonics *b;
    size_t n;              /* numbers in the series; ln w stands behind them */
    double *z, *next;      /* the last point of the branch and the next one */
    double *tangent, *row; /* the tangents there */
    double *rhs, *matrix;  /* of the bordered equations */
    lapack_int *pivot;
    double *time;     /* room for the samples of a motion */
    double direction; /* 1: w rises at first, -1: it falls */
    double ds;        /* arc length of the next step */
    double scale;     /* size of the series */
} dynamics_branch_path;

/* 0: out of memory; what was allocated is freed by dynamics_branch_path_free in any case. */
int dynamics_branch_path_init(dynamics_branch_path *path,
                              const dynamics_continuation_request *request);
void dynamics_branch_path_free(dynamics_branch_path *path);

/* Begins at the point z: finds the tangent there. 0: the equations are singular. */
int dynamics_branch_path_begin(dynamics_branch_path *path);

/* Finds the next point, `next`, and its tangent, `row`; 0: no step is short enough. */
int dynamics_branch_path_step(dynamics_branch_path *path);

/* Makes the next point the last one. */
void dynamics_branch_path_accept(dynamics_branch_path *path);

/* Shortens the next step; 0: it is shorter than the shortest. */
int dynamics_branch_path_shorten(dynamics_branch_path *path);

/* Solves for the motion at ln w = `end`, which lies between the last point and the next, and makes
   it the last point; 0: what was found is on another branch. */
int dynamics_branch_path_end(dynamics_branch_path *path, double end);

#endif
