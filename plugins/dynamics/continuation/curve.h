/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The curve of a periodic motion over the mesh frequency, by pseudo-arclength continuation (Keller
   1977) of the return map in (delta, rate, lambda). Folds are roots of the test function 1 - tr M +
   det M along the arclength, period doublings are roots of 1 + tr M + det M. Each evaluation of a
   test function needs one bordered Newton solution. */
#ifndef DYNAMICS_CURVE_H
#define DYNAMICS_CURVE_H

#include "../orbits/orbit.h"

#include <flankfilm/plugin.h>

enum { DYNAMICS_POINT_PLAIN, DYNAMICS_POINT_FOLD, DYNAMICS_POINT_DOUBLING };

typedef struct dynamics_point {
    int kind;
    double x[2], lambda;
    double tangent[3];     /* derivative of (delta, rate, lambda) with respect to arclength */
    double fold, doubling; /* values of the test functions */
    double largest;        /* largest modulus of the multipliers */
    double direction[2];   /* at a doubling: eigenvector of the multiplier -1 */
    double rms;
} dynamics_point;

/* The reason why a curve ends. */
typedef enum dynamics_curve_end {
    DYNAMICS_END_RANGE,   /* at a bound of the speed range */
    DYNAMICS_END_CLOSED,  /* at its start */
    DYNAMICS_END_HALVED,  /* where the motion becomes a motion of half the period */
    DYNAMICS_END_CAP,     /* at the bound on the amplitude */
    DYNAMICS_END_LOOP,    /* in a loop that does not contain the start: the continuation jumped
                             to a neighbouring curve */
    DYNAMICS_END_STUCK,   /* where no further point was found */
    DYNAMICS_END_CROWDED, /* after the largest number of points */
    DYNAMICS_END_COUNT
} dynamics_curve_end;

typedef struct dynamics_curve {
    int period;
    dynamics_point *points;
    size_t count, capacity;
    dynamics_curve_end first, last; /* at the first and at the last point */
} dynamics_curve;

typedef struct dynamics_continuation_range {
    const dynamics_flow *flow;
    double low, high; /* range of lambda */
    double step;      /* longest step in arclength, with states in state units */
    int moments;      /* 1: points get the rms of their motions */
    const ff_host *host;
    double done; /* fraction of the work, for host->progress */
} dynamics_continuation_range;

/* Follows the curve from a solved orbit: in both directions, or in one direction if the orbit is at
   a bound of the range. Returns FF_OK, FF_NOMEM or FF_STOPPED. */
ff_status dynamics_curve_trace(const dynamics_continuation_range *tracing,
                               const dynamics_orbit *orbit, dynamics_curve *curve);

/* Finds the motion of twice the period that branches off at a period doubling. Returns 0 if none
   was found. */
int dynamics_curve_double(const dynamics_continuation_range *tracing,
                          const dynamics_point *doubling, int period, dynamics_orbit *orbit);

/* Interpolates the state on the curve at a lambda between two neighbouring points. */
void dynamics_curve_between(const dynamics_flow *flow, const dynamics_point *a,
                            const dynamics_point *z, double lambda, double state[2]);

/* Solves for the orbit on the curve at a lambda between two neighbouring points. Returns 0 if none
   was found. */
int dynamics_curve_solve(const dynamics_flow *flow, const dynamics_point *a,
                         const dynamics_point *z, double lambda, dynamics_orbit *orbit);

void dynamics_curve_free(dynamics_curve *curve);

#endif
