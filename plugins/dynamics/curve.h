/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Periodic motions over the mesh frequency: pseudo-arclength continuation (Keller 1977) of the
 * return map in (delta, rate, lambda). Folds and period doublings are the roots, in arclength, of
 * 1 -/+ tr M + det M; each evaluation is a bordered Newton solve.
 */
#ifndef FF_DYNAMICS_CURVE_H
#define FF_DYNAMICS_CURVE_H

#include "orbit.h"

#include <flankfilm/plugin.h>

enum { FF_POINT_PLAIN, FF_POINT_FOLD, FF_POINT_DOUBLING };

typedef struct ff_point {
    int kind;
    double x[2], lambda;
    double tangent[3];     /* of (delta, rate, lambda) over the arclength */
    double fold, doubling; /* test functions */
    double largest;        /* modulus of the multipliers */
    double direction[2];   /* doubling: of the disturbance that turns round */
    double rms;
} ff_point;

/* Why a curve ends. */
typedef enum ff_end {
    FF_END_RANGE,   /* at a bound of the range of speeds */
    FF_END_CLOSED,  /* where it began */
    FF_END_HALVED,  /* in a motion of half the period */
    FF_END_CAP,     /* at the cap of the amplitude */
    FF_END_LOOP,    /* in a loop that the start is no part of: a neighbouring curve */
    FF_END_STUCK,   /* at the shortest step */
    FF_END_CROWDED, /* after too many points */
    FF_END_COUNT
} ff_end;

typedef struct ff_curve {
    int period;
    ff_point *points;
    size_t count, capacity;
    ff_end first, last; /* at the first and the last point */
} ff_curve;

typedef struct ff_tracing {
    const ff_flow *flow;
    double low, high; /* range of lambda */
    double step;      /* longest, in arclength over the state's unit */
    int moments;      /* also rms */
    const ff_host *host;
    double done; /* share of the work, for host->progress */
} ff_tracing;

/* Both ways from a solved orbit, one way at a bound of the range. FF_OK, FF_NOMEM, FF_STOPPED. */
ff_status ff_curve_trace(const ff_tracing *tracing, const ff_orbit *orbit, ff_curve *curve);

/* The motion of twice the period that branches off at a doubling; 0: not found. */
int ff_curve_double(const ff_tracing *tracing, const ff_point *doubling, int period,
                    ff_orbit *orbit);

/* Solves the orbit of the curve between two neighbouring points at a lambda between them. */
int ff_curve_solve(const ff_flow *flow, const ff_point *a, const ff_point *z, double lambda,
                   ff_orbit *orbit);

void ff_curve_free(ff_curve *curve);

#endif
