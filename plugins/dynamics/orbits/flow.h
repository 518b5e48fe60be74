/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Follows the oscillator of excitation.h through a mesh cycle by Taylor series from node to node,
 * split at the instants at which the flanks meet or part. Since k and e are straight between nodes,
 * every motion is followed to round-off, and there is no step size or tolerance to choose.
 *
 * As in oscillator.h the coordinate is delta = s - e, and at a node delta and its rate jump against
 * e and e'.
 */
#ifndef DYNAMICS_FLOW_H
#define DYNAMICS_FLOW_H

#include "../excitation/excitation.h"
#include "../oil/landing.h"
#include "taylor.h"

typedef struct dynamics_flow {
    const dynamics_excitation *excitation;
    double *free_until;    /* for each piece, the phase up to which e stays straight */
    dynamics_radau *radau; /* NULL: no oil between the flanks */
} dynamics_flow;

/* The films on both flanks, with their derivatives. */
typedef struct dynamics_film_state {
    int known; /* 0: at a start, to be set from the motion */
    double film[2];
    double by[4];     /* derivative of (delta, rate) by the start values of the films, by rows */
    double m[2][4];   /* derivative of the films by the start values of (delta, rate, films) */
    double change[2]; /* derivative of the films by T */
} dynamics_film_state;

/* The state at the start or the end of a mesh cycle, before a node there. */
typedef struct dynamics_state {
    double delta, rate;
    double m[4];      /* derivative of (delta, rate) by their start values, by rows */
    double change[2]; /* derivative of (delta, rate) by T */
    double det;       /* of m, as the product over all steps */
    dynamics_film_state oil;
} dynamics_state;

/* A step as an observer sees it: from the phase `at` over x h of the series, in z = delta - side b.
 */
typedef struct dynamics_step {
    const dynamics_excitation *excitation;
    const dynamics_piece *piece;
    const dynamics_taylor_series *series;
    double at, end; /* phases in the cycle */
    double x, T;
    int side, pressed; /* as in oscillator.c */
    int band;          /* of the spring (spring.h) */
    double damper;
    const dynamics_landing
        *landing; /* a step in oil with no flank held; NULL: a step of the series */
} dynamics_step;

typedef struct dynamics_observer {
    void (*observe)(void *ctx, const dynamics_step *step);
    void *ctx;
} dynamics_observer;

int dynamics_flow_init(dynamics_flow *flow,
                       const dynamics_excitation *excitation); /* 0: out of memory */
void dynamics_flow_free(dynamics_flow *flow);

/* Gives the films at the start of a motion: if `known`, those given, where they agree with delta
 * and rate; else the quasi-static ones. */
void dynamics_flow_films(const dynamics_flow *flow, double T, const double x[2], int known,
                         double film[2]);

/* Follows the motion over one mesh cycle of duration T, without or with the derivatives. `observer`
 * may be NULL. 0: too many steps. */
int dynamics_flow_motion(const dynamics_flow *flow, double T, dynamics_state *state,
                         const dynamics_observer *observer);
int dynamics_flow_variation(const dynamics_flow *flow, double T, dynamics_state *state,
                            const dynamics_observer *observer);

/* Gives the start state of a motion, at which M = 1, without and with known films. */
dynamics_state dynamics_state_at(double delta, double rate);
dynamics_state dynamics_state_in_oil(double delta, double rate, const double film[2]);

/* Resets the derivatives at the state that a motion has reached. */
void dynamics_state_restart(dynamics_state *state);

#endif
