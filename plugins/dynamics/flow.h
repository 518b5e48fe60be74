/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The exact way of the oscillator of mesh.h through a mesh cycle: Taylor series from node to node,
 * split at the instants at which the flanks meet or part. Every motion whose k and e are straight
 * between nodes is followed to round-off; nothing is left to choose.
 *
 * As in oscillator.h the coordinate is delta = s - e, and at a node delta and its rate jump against
 * e and e'.
 */
#ifndef FF_DYNAMICS_FLOW_H
#define FF_DYNAMICS_FLOW_H

#include "mesh.h"
#include "taylor.h"

typedef struct ff_flow {
    const ff_mesh *mesh;
    double *free_until; /* phase up to which e goes on straight from each piece */
} ff_flow;

/* At the start or end of a mesh cycle, before the node that may lie there. */
typedef struct ff_state {
    double delta, rate;
    double m[4];      /* derivative of (delta, rate) after their start values, by rows */
    double change[2]; /* derivative of (delta, rate) after T */
    double det;       /* of m, as the product over all steps */
} ff_state;

/* A step as an observer sees it, from phase `at` over x h of the series, in z = delta - side b. */
typedef struct ff_stride {
    const ff_mesh *mesh;
    const ff_piece *piece;
    const ff_series *series;
    double at, end; /* phases in the cycle */
    double x, T;
    int side, pressed; /* as in oscillator.c */
    double damper;
} ff_stride;

typedef struct ff_observer {
    void (*see)(void *ctx, const ff_stride *stride);
    void *ctx;
} ff_observer;

int ff_flow_init(ff_flow *flow, const ff_mesh *mesh); /* 0: out of memory */
void ff_flow_free(ff_flow *flow);

/* Goes on by one mesh cycle of duration T, without or with the derivatives; `observer` may be NULL.
   0: more steps than anybody would wait for. */
int ff_flow_motion(const ff_flow *flow, double T, ff_state *state, const ff_observer *observer);
int ff_flow_variation(const ff_flow *flow, double T, ff_state *state);

/* Start state of a motion, with the derivatives of no cycle yet. */
ff_state ff_state_at(double delta, double rate);

#endif
