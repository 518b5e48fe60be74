/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The conditions that end a step: flanks meet or separate, or the spring bends. */
#include "flow-run.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Makes the gate of a clipped contact: the contact force as a polynomial. The flanks separate where
   it would become negative. */
static void contact_force_gate(const dynamics_run *r, const dynamics_taylor_series *s, double sign,
                               dynamics_gate *g)
{
    double k[DYNAMICS_DEGREE + 1] = {0}, offset[DYNAMICS_DEGREE + 1] = {0};
    double c =
        /* with films the force is that of the teeth alone */
        r->excitation->film ? 0 : 2 * r->excitation->zeta;
    int degree = r->piece->degree;
    double since = r->at - r->piece->start, unit = s->h / r->T;
    dynamics_piece_shift(dynamics_spring_slope(r->piece, r->band), degree, since, unit, k);
    if (r->band)
        dynamics_piece_shift(dynamics_spring_offset(r->piece, r->band), degree, since, unit,
                             offset);
    for (int n = 0; n <= s->order; n++) {
        double value = 0;
        for (int i = 0; i <= degree && i <= n; i++)
            value += k[i] * s->c[n - i][DYNAMICS_Z];
        if (n < s->order)
            value += c * (n + 1) * s->c[n + 1][DYNAMICS_Z] / s->h;
        if (n <= degree && r->band)
            value -= dynamics_spring_sign(r->band) * offset[n];
        g->p[n] = sign * r->side * value;
    }
}

/* Makes the gate at a knee of the spring on one flank. Its value is the force of `line` minus the
   force of the previous line, times `sign`. Returns 0 if the knee is out of reach in this step. The
   bound used: the sum of the absolute coefficients of a product of polynomials is at most the
   product of the sums for its factors. */
static int knee_gate(const dynamics_run *r, const dynamics_taylor_series *s, int flank, int line,
                     double sign, dynamics_gate *g)
{
    const double rounding = 1e-12, tiny = 8 * DBL_EPSILON * (1 + r->excitation->half_gap);
    const dynamics_line *above = &r->piece->line[line], *below = above - 1;
    double change[2][DYNAMICS_DEGREE + 1], steeper[DYNAMICS_DEGREE + 1] = {0},
                                                                     offset[DYNAMICS_DEGREE + 1];
    int degree = r->piece->degree;
    double since = r->at - r->piece->start, unit = s->h / r->T;
    for (int i = 0; i <= degree; i++) {
        change[0][i] = above->slope[i] - below->slope[i];
        change[1][i] = above->offset[i] - below->offset[i];
    }
    dynamics_piece_shift(change[0], degree, since, unit, steeper);
    dynamics_piece_shift(change[1], degree, since, unit, offset);
    double slopes = 0, way = 0, moved = 0, start = steeper[0] * s->c[0][DYNAMICS_Z];
    for (int i = 0; i <= degree; i++) {
        slopes += fabs(steeper[i]);
        moved += i ? fabs(offset[i]) : 0;
    }
    for (int n = 0; n <= s->order; n++)
        way += fabs(s->c[n][DYNAMICS_Z]);
    double from = sign * (flank * start - offset[0]);
    if (from > tiny && from > (1 + rounding) * slopes * way - fabs(start) + moved)
        return 0;
    for (int n = 0; n <= s->order; n++) {
        double value = 0;
        for (int i = 0; i <= degree && i <= n; i++)
            value += steeper[i] * s->c[n - i][DYNAMICS_Z];
        g->p[n] = sign * (flank * value - (n <= degree ? offset[n] : 0));
    }
    g->knee = 1;
    g->side = r->side;
    g->pressed = r->pressed;
    g->band = flank * (sign > 0 ? line - 1 : line);
    return 1;
}

/* Adds the gates at the knees that can be reached from the current contact. Returns the number of
   all gates. */
static int add_knees(const dynamics_run *r, const dynamics_taylor_series *s, int count,
                     dynamics_gate *g)
{
    if (!dynamics_spring_bends(r->piece) || !r->side)
        return count;
    int on = dynamics_spring_sign(r->band), line = abs(r->band);
    if (line)
        count += knee_gate(r, s, on, line, 1, &g[count]);
    for (int flank = -1; flank <= 1 && line + 1 < r->piece->lines; flank += 2)
        if (on ? flank == on : flank == r->side || r->excitation->half_gap == 0)
            count += knee_gate(r, s, flank, line + 1, -1, &g[count]);
    return count;
}

/* Makes the gate at an edge of the gap: sign z + offset. */
static void gap_edge_gate(const dynamics_taylor_series *s, double sign, double offset,
                          dynamics_gate *g)
{
    for (int n = 0; n <= s->order; n++)
        g->p[n] = sign * s->c[n][DYNAMICS_Z];
    g->p[0] += offset;
}

/* Returns the order of a gate in free flight. */
static int flight_order(const dynamics_run *r, const dynamics_taylor_series *s)
{
    return dynamics_tracks_differ(r->excitation) && s->order < DYNAMICS_DEGREE ? DYNAMICS_DEGREE
                                                                               : s->order;
}

/* Expresses the gate at an edge of the gap on the track of its flank. The step lies within one
 * piece of that track. */
static void move_edge(const dynamics_run *r, const dynamics_taylor_series *s, dynamics_gate *g)
{
    const dynamics_track track = dynamics_track_of(r->excitation, g->side);
    double from[DYNAMICS_DEGREE + 1] = {0}, to[DYNAMICS_DEGREE + 1] = {0}, unit = s->h / r->T;
    for (int n = s->order + 1; n <= flight_order(r, s); n++)
        g->p[n] = 0;
    if (dynamics_track_holds(track, r->piece))
        return;
    const dynamics_piece *p = dynamics_track_piece(track, r->at + 0.5 * unit, 0);
    dynamics_piece_shift(r->piece->e, r->piece->degree, r->at - r->piece->start, unit, from);
    dynamics_piece_shift(p->e, p->degree, r->at - p->start, unit, to);
    for (int n = 0; n <= DYNAMICS_DEGREE; n++)
        g->p[n] -= g->side * (from[n] - to[n]);
}

/* Lists the gates of the current contact. Returns their number. */
static int find_gates(const dynamics_run *r, const dynamics_taylor_series *s,
                      dynamics_gate g[DYNAMICS_RUN_GATES])
{
    double b = r->excitation->half_gap;
    for (int i = 0; i < DYNAMICS_RUN_GATES; i++)
        g[i].knee = g[i].band = 0;
    if (r->excitation->film && r->excitation->film->rolling) {
        double load[2];
        dynamics_run_holding_load(r, r->end, load);
        contact_force_gate(r, s, 1, &g[0]);
        g[0].p[0] -= load[0];
        g[0].p[1] -= load[1];
        g[0].side = g[0].pressed = 0;
        return 1;
    }
    if (r->side == 0) {
        g[0].side = g[0].pressed = g[1].pressed = 1;
        g[1].side = -1;
        gap_edge_gate(s, -1, b, &g[0]);
        gap_edge_gate(s, 1, b, &g[1]);
        for (int i = 0; i < 2 && dynamics_tracks_differ(r->excitation); i++)
            move_edge(r, s, &g[i]);
        return 2;
    }
    int clipped = r->excitation->damping == DYNAMICS_DAMPING_CLIPPED;
    if (clipped && r->pressed) {
        g[0].side = r->side, g[0].pressed = 0;
        contact_force_gate(r, s, 1, &g[0]);
        return 1;
    }
    g[0].side = g[0].pressed = 0;
    gap_edge_gate(s, r->side, 0, &g[0]);
    if (!clipped)
        return 1;
    g[1].side = r->side, g[1].pressed = 1;
    contact_force_gate(r, s, -1, &g[1]);
    return 2;
}

/* Returns a lower bound on the distance from z to the edges of the gap. */
static double room_in_flight(const dynamics_excitation *x, double z)
{
    const double share = x->flight_share;
    if (!dynamics_tracks_differ(x))
        return x->half_gap - fabs(z);
    return x->half_gap + fmin(share * x->back_room - z, (1 - share) * x->back_room + z);
}

/* The sum of the absolute values of all terms bounds the motion towards the edge. */
int dynamics_run_misses_edge(const dynamics_run *r, const dynamics_taylor_series *s, double tiny)
{
    double z = s->c[0][DYNAMICS_Z], first = s->c[1][DYNAMICS_Z];
    double reach = tiny + (r->side * first > 0 ? 0 : fabs(first));
    double room = r->side ? r->side * z : room_in_flight(r->excitation, z);
    for (int n = 2; n <= s->order; n++)
        reach += fabs(s->c[n][DYNAMICS_Z]);
    if (r->excitation->film && r->excitation->film->rolling)
        return 0;
    return room > reach && (r->excitation->damping != DYNAMICS_DAMPING_CLIPPED || r->side == 0);
}

double dynamics_run_find_event(const dynamics_run *r, const dynamics_taylor_series *s,
                               dynamics_gate g[DYNAMICS_RUN_GATES], const dynamics_gate **which)
{
    double tiny = 8 * DBL_EPSILON * (1 + r->excitation->half_gap), first = -1;
    int count = r->excitation->half_gap == 0 || dynamics_run_misses_edge(r, s, tiny)
                    ? 0
                    : find_gates(r, s, g);
    count = add_knees(r, s, count, g);
    for (int i = 0; i < count; i++) {
        double x = dynamics_taylor_first_exit(
            g[i].p, r->side || g[i].knee ? s->order : flight_order(r, s), tiny);
        if (x < 0 || (first >= 0 && x >= first))
            continue;
        first = x;
        *which = &g[i];
    }
    return first;
}
