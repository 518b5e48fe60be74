/* SPDX-License-Identifier: GPL-3.0-or-later */
/* State of an oscillator between its steps, shared by the equation of motion, the gates at which
 * its regime changes, and the stepping. */
#ifndef DYNAMICS_OSCILLATOR_STATE_H
#define DYNAMICS_OSCILLATOR_STATE_H

#include "../../numerics/integrator.h"
#include "../excitation/spring.h"
#include "../excitation/tracks.h"
#include "oscillator.h"

struct dynamics_oscillator {
    const dynamics_excitation *excitation;
    numerics_integrator gsl;
    gsl_odeiv2_system system;
    double y[DYNAMICS_STATE_SIZE];
    int side;    /* 1: driving flanks touch, -1: back flanks, 0: neither */
    int pressed; /* 0 with side != 0: the flanks touch without force, since the clipped damper
                    limits the speed at which the teeth spring back */
    int band;    /* band of the spring force (spring.h) */
    const dynamics_piece *piece;
    double T;       /* duration of the mesh cycle */
    double t;       /* time since the start of the piece */
    int refine;     /* divisor of the longest step and of each piece */
    double longest; /* the longest step */
    double cap;     /* longest step in this piece */
    double h;       /* length of the next step */
    dynamics_clocks clocks;
    size_t steps;
};

/* A gate is a condition that holds while `value` is not negative. When it becomes negative, the
   regime changes to (side, pressed); at a knee only the band of the spring changes. */
typedef struct dynamics_oscillator_gate {
    double value, rate;
    int side, pressed, knee, band;
} dynamics_oscillator_gate;

enum { DYNAMICS_OSCILLATOR_GATES = 4 };

/* Returns the slope of the spring force in the current band. */
static inline double dynamics_oscillator_stiffness(const dynamics_oscillator *o, double t)
{
    return dynamics_piece_value(dynamics_spring_slope(o->piece, o->band), o->piece->degree,
                                t / o->T);
}

static inline double dynamics_oscillator_stiffness_rate(const dynamics_oscillator *o, double t)
{
    return dynamics_piece_slope(dynamics_spring_slope(o->piece, o->band), o->piece->degree,
                                t / o->T) /
           o->T;
}

/* Returns slope times deflection minus the spring force, in the current band. */
static inline double dynamics_oscillator_offset(const dynamics_oscillator *o, double t)
{
    return o->band ? dynamics_spring_sign(o->band) *
                         dynamics_piece_value(dynamics_spring_offset(o->piece, o->band),
                                              o->piece->degree, t / o->T)
                   : 0;
}

static inline double dynamics_oscillator_offset_rate(const dynamics_oscillator *o, double t)
{
    return o->band ? dynamics_spring_sign(o->band) *
                         dynamics_piece_slope(dynamics_spring_offset(o->piece, o->band),
                                              o->piece->degree, t / o->T) /
                         o->T
                   : 0;
}

static inline double dynamics_oscillator_error(const dynamics_oscillator *o, double t)
{
    return dynamics_piece_value(o->piece->e, o->piece->degree, t / o->T);
}

static inline double dynamics_oscillator_error_rate(const dynamics_oscillator *o, double t)
{
    return dynamics_piece_slope(o->piece->e, o->piece->degree, t / o->T) / o->T;
}

static inline double dynamics_oscillator_drag(const dynamics_oscillator *o, double t)
{
    return o->excitation->drags ? dynamics_piece_value(o->piece->drag, o->piece->degree, t / o->T)
                                : 0;
}

static inline double dynamics_oscillator_error_bend(const dynamics_oscillator *o, double t)
{
    return dynamics_piece_bend(o->piece->e, o->piece->degree, t / o->T) / (o->T * o->T);
}

/* Returns the force that drives delta: load minus drag minus e''. */
static inline double dynamics_oscillator_drive(const dynamics_oscillator *o, double t)
{
    return o->excitation->load - dynamics_oscillator_drag(o, t) -
           dynamics_oscillator_error_bend(o, t);
}

static inline int dynamics_oscillator_is_damped(const dynamics_oscillator *o)
{
    return o->excitation->damping == DYNAMICS_DAMPING_ALWAYS || o->excitation->half_gap == 0 ||
           o->pressed;
}

/* The change of delta and of its rate when the motion changes to another track. */
typedef struct dynamics_oscillator_move {
    const dynamics_piece *piece;
    double since, delta, rate; /* since: phase from the start of the piece */
} dynamics_oscillator_move;

/* Evaluates the equation of motion for the integrator. */
int dynamics_oscillator_derivative(double t, const double y[], double dydt[], void *self);
void dynamics_oscillator_find_band(dynamics_oscillator *o);
void dynamics_oscillator_enter(dynamics_oscillator *o, const dynamics_piece *piece, double T);

/* Returns the change of delta and rate for the track of a side, at time t of the current piece. */
dynamics_oscillator_move dynamics_oscillator_shift(const dynamics_oscillator *o, double t,
                                                   int side);
/* Changes to the track of a side; s and s' are continuous. */
void dynamics_oscillator_take_track(dynamics_oscillator *o, int side);

/* Lists the gates of the present regime. Returns their number. */
int dynamics_oscillator_gates(const dynamics_oscillator *o, double t, const double *y,
                              dynamics_oscillator_gate g[DYNAMICS_OSCILLATOR_GATES]);

#endif
