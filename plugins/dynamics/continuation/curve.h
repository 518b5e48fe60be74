/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The curve of a periodic motion over the mesh frequency, by pseudo-arclength continuation (Keller
 * 1977) of the return map in (delta, rate, lambda). Folds are the roots in arclength of 1 - tr M +
 * det M, doublings those of 1 + tr M + det M. Each value takes a bordered Newton solution. */
#ifndef DYNAMICS_CURVE_H
#define DYNAMICS_CURVE_H

#include "../orbits/orbit.h"

#include <flankfilm/plugin.h>

enum { DYNAMICS_POINT_PLAIN, DYNAMICS_POINT_FOLD, DYNAMICS_POINT_DOUBLING };

typedef struct dynamics_point {
    int kind;
    double x[2], lambda;
    double tangent[3];     /* derivative of (delta, rate, lambda) by the arclength */
    double fold, doubling; /* test functions */
    double largest;        /* largest modulus of the multipliers */
    double direction[2];   /* at a doubling: eigenvector of the multiplier -1 */
    double rms;
} dynamics_point;

/* Why a curve ends. */
typedef enum dynamics_curve_end {
    DYNAMICS_END_RANGE,   /* at a bound of the range of speeds */
    DYNAMICS_END_CLOSED,  /* where it began */
    DYNAMICS_END_HALVED,  /* in a motion of half the period */
    DYNAMICS_END_CAP,     /* at the cap of the amplitude */
    DYNAMICS_END_LOOP,    /* in a loop that the start is no part of: a neighbouring curve */
    DYNAMICS_END_STUCK,   /* in a loop that does not contain the start: on a neighbouring curve */
    DYNAMICS_END_CROWDED, /* after too many points */
    DYNAMICS_END_COUNT
} dynamics_curve_end;

typedef struct dynamics_curve {
    int period;
    dynamics_point *points;
    size_t count, capacity;
    dynamics_curve_end first, last; /* at the first and the last point */
} dynamics_curve;

typedef struct dynamics_continuation_range {
    const dynamics_flow *flow;
    double low, high; /* range of lambda */
    double step;      /* the longest step, in arclength with states in their unit */
    int moments;      /* 1: points get their rms */
    const ff_host *host;
    double done; /* share of the work, for host->progress */
} dynamics_continuation_range;

/* Follows the curve both ways from a solved orbit, or one way from a bound of the range. Returns
 * FF_OK, FF_NOMEM or FF_STOPPED. */
ff_status dynamics_curve_trace(const dynamics_continuation_range *tracing,
                               const dynamics_orbit *orbit, dynamics_curve *curve);

/* Finds the motion of twice the period that branches off at a doubling. 0: none was found. */
int dynamics_curve_double(const dynamics_continuation_range *tracing,
                          const dynamics_point *doubling, int period, dynamics_orbit *orbit);

/* Gives the state near the curve between two neighbouring points, at a lambda between theirs. */
void dynamics_curve_between(const dynamics_flow *flow, const dynamics_point *a,
                            const dynamics_point *z, double lambda, double state[2]);

/* Solves the orbit of the curve between two neighbouring points, at a lambda between theirs. */
int dynamics_curve_solve(const dynamics_flow *flow, const dynamics_point *a,
                         const dynamics_point *z, double lambda, dynamics_orbit *orbit);

void dynamics_curve_free(dynamics_curve *curve);

#endif
