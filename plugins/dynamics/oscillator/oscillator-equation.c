/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The equation of motion of the oscillator, and its tracks. */
#include "oscillator-state.h"

#include <math.h>

void dynamics_oscillator_find_band(dynamics_oscillator *o)
{
    double bend = o->y[DYNAMICS_DELTA] - o->side * o->excitation->half_gap;
    o->band = o->side ? dynamics_spring_band(o->piece, o->t / o->T, bend) : 0;
}

static double energy_rate_at(const dynamics_oscillator *o, double t, double bend)
{
    return dynamics_spring_at(o->piece, t / o->T, o->T, bend, o->band).energy_rate;
}

/* Evaluates the equation of excitation.h in delta = s - e, its variational equation, and the powers
   of damper and excitation. The power of the excitation excludes that of the drag. */
int dynamics_oscillator_derivative(double t, const double y[], double dydt[], void *self)
{
    const dynamics_oscillator *o = self;
    double k = o->pressed ? dynamics_oscillator_stiffness(o, t) : 0;
    double c = dynamics_oscillator_is_damped(o) ? 2 * o->excitation->zeta : 0;
    double bend = y[DYNAMICS_DELTA] - o->side * o->excitation->half_gap;
    double force =
        c * y[DYNAMICS_RATE] + k * bend - (o->pressed ? dynamics_oscillator_offset(o, t) : 0);
    dydt[DYNAMICS_DELTA] = y[DYNAMICS_RATE];
    dydt[DYNAMICS_RATE] = dynamics_oscillator_drive(o, t) - force;
    if (o->system.dimension == DYNAMICS_MOTION)
        return GSL_SUCCESS;
    dydt[DYNAMICS_M11] = y[DYNAMICS_M21];
    dydt[DYNAMICS_M12] = y[DYNAMICS_M22];
    dydt[DYNAMICS_M21] = -c * y[DYNAMICS_M21] - k * y[DYNAMICS_M11];
    dydt[DYNAMICS_M22] = -c * y[DYNAMICS_M22] - k * y[DYNAMICS_M12];
    dydt[DYNAMICS_LOSS] = c * y[DYNAMICS_RATE] * y[DYNAMICS_RATE];
    dydt[DYNAMICS_WORK] =
        (o->pressed ? energy_rate_at(o, t, bend) : 0) -
        force * dynamics_oscillator_error_rate(o, t) -
        dynamics_oscillator_drag(o, t) * (y[DYNAMICS_RATE] + dynamics_oscillator_error_rate(o, t));
    return GSL_SUCCESS;
}

/* Enters a piece; a mesh cycle lasts T. */
void dynamics_oscillator_enter(dynamics_oscillator *o, const dynamics_piece *piece, double T)
{
    o->piece = piece;
    o->T = T;
    o->cap = fmin(o->longest, piece->length * T / o->refine);
    o->t = 0;
}

/* Returns the change of delta and of its rate for the track of a side, at time t of the current
 * piece. */
dynamics_oscillator_move dynamics_oscillator_shift(const dynamics_oscillator *o, double t, int side)
{
    const dynamics_track track = dynamics_track_of(o->excitation, side);
    dynamics_oscillator_move x = {.piece = o->piece, .since = t / o->T};
    if (dynamics_track_holds(track, o->piece))
        return x;
    double phase = o->piece->start + x.since;
    x.piece = dynamics_track_piece(track, phase, 0);
    x.since = phase - x.piece->start;
    x.delta = dynamics_oscillator_error(o, t) -
              dynamics_piece_value(x.piece->e, x.piece->degree, x.since);
    x.rate = dynamics_oscillator_error_rate(o, t) -
             dynamics_piece_slope(x.piece->e, x.piece->degree, x.since) / o->T;
    return x;
}

/* Changes to the track of a side; s and s' are continuous. */
void dynamics_oscillator_take_track(dynamics_oscillator *o, int side)
{
    dynamics_oscillator_move x = dynamics_oscillator_shift(o, o->t, side);
    if (x.piece == o->piece)
        return;
    dynamics_oscillator_enter(o, x.piece, o->T);
    o->t = x.since * o->T;
    o->y[DYNAMICS_DELTA] += x.delta;
    o->y[DYNAMICS_RATE] += x.rate;
}

double dynamics_oscillator_energy(const dynamics_oscillator *o)
{
    double s = o->y[DYNAMICS_DELTA] + dynamics_oscillator_error(o, o->t);
    double s_rate = o->y[DYNAMICS_RATE] + dynamics_oscillator_error_rate(o, o->t);
    double bend = o->pressed ? o->y[DYNAMICS_DELTA] - o->side * o->excitation->half_gap : 0;
    double stored =
        dynamics_spring_at(o->piece, o->t / o->T, o->T, bend, bend != 0 ? o->band : 0).energy;
    return 0.5 * s_rate * s_rate + stored - o->excitation->load * s;
}
