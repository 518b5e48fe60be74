/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Follows the oscillator of excitation.h through a mesh cycle by Taylor series from node to node,
 * split at the instants at which flanks meet or separate. k and e are polynomials between nodes, so
 * that every motion is integrated to round-off, without a step size or a tolerance.
 * As in oscillator.h the coordinate is delta = s - e, and at a node delta and its rate jump by
 * minus the jumps of e and e'.
 */
#ifndef DYNAMICS_FLOW_H
#define DYNAMICS_FLOW_H

#include "../excitation/excitation.h"
#include "../oil/landing.h"
#include "taylor.h"

typedef struct dynamics_flow {
    const dynamics_excitation *excitation;
    double *free_until;    /* for each piece of free flight, the phase up to which e is one
                              straight line */
    dynamics_radau *radau; /* NULL: no oil between the flanks */
} dynamics_flow;

/* The films on both flanks and their derivatives. */
typedef struct dynamics_film_state {
    int known; /* 0: at the start of a motion whose films are computed from delta and rate */
    double film[2];
    double by[4];     /* derivative of (delta, rate) with respect to the start values of the
                         films, row by row */
    double m[2][4];   /* derivative of the films with respect to the start values of (delta,
                         rate, films) */
    double change[2]; /* derivative of the films with respect to T */
} dynamics_film_state;

/* The state at the start or the end of a mesh cycle, before a jump of the excitation there. */
typedef struct dynamics_state {
    double delta, rate;
    double m[4];      /* derivative of (delta, rate) with respect to their start values, row by
                         row */
    double change[2]; /* derivative of (delta, rate) with respect to T */
    double det;       /* determinant of m, as the product over all steps */
    dynamics_film_state oil;
} dynamics_state;

/* A step as passed to an observer. It begins at the phase `at` and lasts x h, with the series in z
   = delta - side b. */
typedef struct dynamics_step {
    const dynamics_excitation *excitation;
    const dynamics_piece *piece;
    const dynamics_taylor_series *series;
    double at, end; /* phases in the cycle */
    double x, T;
    int side, pressed; /* see oscillator-state.h */
    int band;          /* band of the spring (spring.h) */
    double damper;
    const dynamics_landing *landing; /* set in a step with oil while no flank is held; NULL: the
                                        step is that of the Taylor series */
} dynamics_step;

typedef struct dynamics_observer {
    void (*observe)(void *ctx, const dynamics_step *step);
    void *ctx;
} dynamics_observer;

int dynamics_flow_init(dynamics_flow *flow,
                       const dynamics_excitation *excitation); /* 0: out of memory */
void dynamics_flow_free(dynamics_flow *flow);

/* Sets the films at the start of a motion. If `known`, films that agree with delta and rate are
   kept; the other films get their quasi-static thickness. */
void dynamics_flow_films(const dynamics_flow *flow, double T, const double x[2], int known,
                         double film[2]);

/* Integrate the motion over one mesh cycle of duration T, without and with the derivatives.
   `observer` may be NULL. Returns 0 if there are too many steps. */
int dynamics_flow_motion(const dynamics_flow *flow, double T, dynamics_state *state,
                         const dynamics_observer *observer);
int dynamics_flow_variation(const dynamics_flow *flow, double T, dynamics_state *state,
                            const dynamics_observer *observer);

/* Return the start state of a motion, with the unit matrix as monodromy: without and with known
   films. */
dynamics_state dynamics_state_at(double delta, double rate);
dynamics_state dynamics_state_in_oil(double delta, double rate, const double film[2]);

/* Resets the derivatives at the current state of a motion. */
void dynamics_state_restart(dynamics_state *state);

#endif
