/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gates of the oscillator: flanks meet or separate, or the spring force changes to another line. */
#include "oscillator-state.h"

#include <stdlib.h>

/* Lists the gates at which flanks meet or separate. Returns their number. */
static int find_contact_gates(const dynamics_oscillator *o, double t, const double *y,
                              dynamics_oscillator_gate g[DYNAMICS_OSCILLATOR_GATES])
{
    double b = o->excitation->half_gap, sign = o->side;
    if (b == 0)
        return 0;
    if (o->side == 0) {
        g[0] = (dynamics_oscillator_gate){
            .value = b - y[DYNAMICS_DELTA], .rate = -y[DYNAMICS_RATE], .side = 1};
        g[1] = (dynamics_oscillator_gate){
            .value = b + y[DYNAMICS_DELTA], .rate = y[DYNAMICS_RATE], .side = -1};
        g[0].pressed = g[1].pressed = 1;
        for (int i = 0; i < 2 && dynamics_tracks_differ(o->excitation); i++) {
            dynamics_oscillator_move off = dynamics_oscillator_shift(o, t, g[i].side);
            g[i].value -= g[i].side * off.delta;
            g[i].rate -= g[i].side * off.rate;
        }
        return 2;
    }
    dynamics_oscillator_gate touch = {.value = sign * y[DYNAMICS_DELTA] - b,
                                      .rate = sign * y[DYNAMICS_RATE]};
    if (o->excitation->damping != DYNAMICS_DAMPING_CLIPPED) {
        g[0] = touch;
        return 1;
    }
    double k = dynamics_oscillator_stiffness(o, t), c = 2 * o->excitation->zeta;
    double push = k * touch.value + c * touch.rate - sign * dynamics_oscillator_offset(o, t);
    double bend_rate = sign * (dynamics_oscillator_drive(o, t) - (o->pressed ? sign * push : 0));
    double push_rate = dynamics_oscillator_stiffness_rate(o, t) * touch.value + k * touch.rate +
                       c * bend_rate - sign * dynamics_oscillator_offset_rate(o, t);
    if (o->pressed) {
        g[0] = (dynamics_oscillator_gate){.value = push, .rate = push_rate, .side = o->side};
        return 1;
    }
    g[0] = touch;
    g[1] = (dynamics_oscillator_gate){
        .value = -push, .rate = -push_rate, .side = o->side, .pressed = 1};
    return 2;
}

/* Makes the dynamics_oscillator_gate at a knee of the spring on one flank. Its value is the force
   of `line` minus the force of the previous line, times `sign`. */
static dynamics_oscillator_gate knee_gate(const dynamics_oscillator *o, double t, const double *y,
                                          int flank, int line, double sign)
{
    const dynamics_piece *p = o->piece;
    const dynamics_line *above = &p->line[line], *below = above - 1;
    double since = t / o->T, bend = flank * (y[DYNAMICS_DELTA] - o->side * o->excitation->half_gap);
    double steeper = dynamics_piece_value(above->slope, p->degree, since) -
                     dynamics_piece_value(below->slope, p->degree, since);
    double steeper_rate = (dynamics_piece_slope(above->slope, p->degree, since) -
                           dynamics_piece_slope(below->slope, p->degree, since)) /
                          o->T;
    double offset_rate = (dynamics_piece_slope(above->offset, p->degree, since) -
                          dynamics_piece_slope(below->offset, p->degree, since)) /
                         o->T;
    double rate = steeper_rate * bend + steeper * flank * y[DYNAMICS_RATE] - offset_rate;
    return (dynamics_oscillator_gate){.value = sign * dynamics_spring_excess(p, line, since, bend),
                                      .rate = sign * rate,
                                      .side = o->side,
                                      .pressed = o->pressed,
                                      .knee = 1,
                                      .band = flank * (sign > 0 ? line - 1 : line)};
}

/* Lists the gates of the current regime. Returns their number. */
int dynamics_oscillator_gates(const dynamics_oscillator *o, double t, const double *y,
                              dynamics_oscillator_gate g[DYNAMICS_OSCILLATOR_GATES])
{
    int count = find_contact_gates(o, t, y, g);
    if (!dynamics_spring_bends(o->piece) || !o->side)
        return count;
    int on = dynamics_spring_sign(o->band), line = abs(o->band);
    if (line)
        g[count++] = knee_gate(o, t, y, on, line, 1);
    for (int flank = -1; flank <= 1 && line + 1 < o->piece->lines; flank += 2)
        if (on ? flank == on : flank == o->side || o->excitation->half_gap == 0)
            g[count++] = knee_gate(o, t, y, flank, line + 1, -1);
    return count;
}
