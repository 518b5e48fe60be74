/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow-run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A kink of e below this relative size is round-off. */
static const double round_off = 1e-12;

/* The integration fails after this many steps in one mesh cycle. */
static const size_t step_limit = 20000000;

dynamics_state dynamics_state_at(double delta, double rate)
{
    dynamics_state y = {.delta = delta, .rate = rate};
    dynamics_state_restart(&y);
    return y;
}

dynamics_state dynamics_state_in_oil(double delta, double rate, const double film[2])
{
    dynamics_state y = dynamics_state_at(delta, rate);
    y.oil.known = 1;
    memcpy(y.oil.film, film, sizeof y.oil.film);
    return y;
}

void dynamics_state_restart(dynamics_state *y)
{
    static const double one[4] = {1, 0, 0, 1};
    memcpy(y->m, one, sizeof y->m);
    y->change[0] = y->change[1] = 0;
    y->det = 1;
    dynamics_film_state oil = {.m = {{0, 0, 1, 0}, {0, 0, 0, 1}}, .known = y->oil.known};
    memcpy(oil.film, y->oil.film, sizeof oil.film);
    y->oil = oil;
}

static int is_straight(const dynamics_piece *p)
{
    for (int i = 2; i <= p->degree; i++)
        if (p->e[i] != 0)
            return 0;
    return 1;
}

static int bends_after(const dynamics_piece *p)
{
    double length = p[0].length + p[1].length;
    return !is_straight(&p[0]) || !is_straight(&p[1]) ||
           fabs(p->e[0] + p->e[1] * p->length - p[1].e[0]) > round_off ||
           fabs(p->e[1] - p[1].e[1]) * length > round_off;
}

int dynamics_flow_init(dynamics_flow *flow, const dynamics_excitation *excitation)
{
    const dynamics_track flight = dynamics_track_of(excitation, 0);
    *flow = (dynamics_flow){.excitation = excitation};
    flow->free_until = malloc(flight.count * sizeof *flow->free_until);
    if (excitation->film)
        flow->radau = malloc(sizeof *flow->radau);
    if (!flow->free_until || (excitation->film && !flow->radau))
        return 0;
    if (flow->radau)
        dynamics_radau_init(flow->radau);
    for (size_t i = flight.count; i-- > 0;) {
        const dynamics_piece *p = &flight.pieces[i];
        int last = i + 1 == flight.count;
        flow->free_until[i] = last || excitation->drags || bends_after(p)
                                  ? dynamics_piece_end(excitation, p)
                                  : flow->free_until[i + 1];
    }
    return 1;
}

void dynamics_flow_free(dynamics_flow *flow)
{
    free(flow->free_until);
    free(flow->radau);
    *flow = (dynamics_flow){.excitation = NULL};
}

static int damper_acts(const dynamics_run *r)
{
    return r->excitation->damping == DYNAMICS_DAMPING_ALWAYS || r->excitation->half_gap == 0 ||
           r->pressed;
}

/* Selects the band of the spring from the state. */
static void find_band(dynamics_run *r)
{
    double bend = r->y->delta - r->side * r->excitation->half_gap;
    r->band = r->side ? dynamics_spring_band(r->piece, r->at - r->piece->start, bend) : 0;
}

/* The change of delta and of its rate when the motion changes to another track (tracks.h). */
typedef struct shift {
    const dynamics_piece *piece;
    double delta, rate;
} shift;

static shift shift_to(const dynamics_run *r, int side, double phase)
{
    const dynamics_track track = dynamics_track_of(r->excitation, side);
    const dynamics_piece *from = r->piece, *to = from;
    if (dynamics_track_holds(track, from))
        return (shift){from, 0, 0};
    to = dynamics_track_piece(track, phase, 0);
    return (shift){to,
                   dynamics_piece_value(from->e, from->degree, phase - from->start) -
                       dynamics_piece_value(to->e, to->degree, phase - to->start),
                   (dynamics_piece_slope(from->e, from->degree, phase - from->start) -
                    dynamics_piece_slope(to->e, to->degree, phase - to->start)) /
                       r->T};
}

/* Changes to the track of a side; s and s' are continuous. */
static void take_track(dynamics_run *r, int side, double phase)
{
    const shift x = shift_to(r, side, phase);
    if (x.piece == r->piece)
        return;
    r->piece = x.piece;
    r->y->delta += x.delta;
    r->y->rate += x.rate;
    r->y->change[1] -= x.rate / r->T;
}

/* Selects the contact and its track, if the flanks have different tracks. */
static void find_contact_on_tracks(dynamics_run *r, double phase)
{
    const shift ahead = shift_to(r, 1, phase), behind = shift_to(r, -1, phase);
    double b = r->excitation->half_gap, delta = r->y->delta, rate = r->y->rate;
    double front = delta + ahead.delta, back = delta + behind.delta;
    r->side = (front > b || (front == b && rate + ahead.rate >= 0)) -
              (back < -b || (back == -b && rate + behind.rate < 0));
    r->pressed = r->side != 0;
    take_track(r, r->side, phase);
}

/* Selects the contact from the state. At the edge of the gap the sign of the rate decides. If the
   rate is 0 there, the load decides, which presses the driving flanks together. */
static void find_contact(dynamics_run *r, double phase)
{
    double b = r->excitation->half_gap, delta = r->y->delta, rate = r->y->rate;
    if (r->excitation->film) {
        dynamics_run_find_films(r);
        return;
    }
    if (dynamics_tracks_differ(r->excitation)) {
        find_contact_on_tracks(r, phase);
        return;
    }
    r->side = (delta > b || (delta == b && rate >= 0)) - (delta < -b || (delta == -b && rate < 0));
    if (b == 0)
        r->side = 1;
    r->pressed = r->side != 0;
}

/* Crosses a node. s and s' are continuous there, so delta = s - e jumps by minus the jump of e. The
   damper turns a jump of e into an impulse of 2 zeta times that jump. */
static void enter_piece(dynamics_run *r, const dynamics_piece *before, const dynamics_piece *piece)
{
    double e = dynamics_piece_value(before->e, before->degree, before->length);
    double slope = dynamics_piece_slope(before->e, before->degree, before->length);
    double leap = piece->jump ? piece->e[0] - e : 0;
    double kink = (slope - piece->e[1]) / r->T;
    r->y->delta -= leap;
    r->y->rate += kink + (damper_acts(r) ? 2 * r->excitation->zeta * leap : 0);
    r->y->change[1] -= kink / r->T;
    r->piece = piece;
    if (leap != 0 && r->excitation->film)
        dynamics_run_follow_flanks(r);
    if (leap != 0)
        find_contact(r, piece->start);
    find_band(r);
}

/* Advances the state by x h along the series. */
static void move_state(dynamics_run *r, const dynamics_taylor_series *s, double x)
{
    dynamics_state *y = r->y;
    double offset = r->side * r->excitation->half_gap, at[2];
    if (!r->variation) {
        dynamics_taylor_at(s, DYNAMICS_Z, x, at);
        y->delta = at[0] + offset;
        y->rate = at[1];
        return;
    }
    double v[DYNAMICS_COLUMNS], w[DYNAMICS_COLUMNS], m[4] = {y->m[0], y->m[1], y->m[2], y->m[3]};
    dynamics_taylor_columns_at(s, x, v, w);
    y->delta = v[DYNAMICS_Z] + offset;
    y->rate = w[DYNAMICS_Z];
    y->change[0] = v[DYNAMICS_Z_T];
    y->change[1] = w[DYNAMICS_Z_T] - w[DYNAMICS_Z] / r->T;
    y->m[0] = v[DYNAMICS_PHI_1] * m[0] + v[DYNAMICS_PHI_2] * m[2];
    y->m[1] = v[DYNAMICS_PHI_1] * m[1] + v[DYNAMICS_PHI_2] * m[3];
    y->m[2] = w[DYNAMICS_PHI_1] * m[0] + w[DYNAMICS_PHI_2] * m[2];
    y->m[3] = w[DYNAMICS_PHI_1] * m[1] + w[DYNAMICS_PHI_2] * m[3];
    if (r->excitation->film)
        dynamics_run_carry_films(r, &v[DYNAMICS_PHI_1], &w[DYNAMICS_PHI_1]);
    y->det *= v[DYNAMICS_PHI_1] * w[DYNAMICS_PHI_2] - v[DYNAMICS_PHI_2] * w[DYNAMICS_PHI_1];
}

/* Does the same as change_contact for flanks with different tracks. The damper then uses another e,
   so its force jumps at the edge of the gap; the flank approaches this edge at the rate `edge`. If
   a jump of e moves the edge past the current position, the derivatives are not changed. */
static void change_track(dynamics_run *r, const dynamics_gate *g)
{
    const int flank = g->side ? g->side : r->side;
    const double b = r->excitation->half_gap, gap = flank * b;
    const shift x = shift_to(r, flank, r->at);
    const double edge = r->y->rate + x.rate, before = damper_acts(r) * r->y->rate;
    const int passes = fabs(r->y->delta + x.delta - gap) <= 1e-9 * (1 + b);
    if (r->side && passes)
        r->y->delta = gap;
    take_track(r, g->side, r->at);
    if (!r->side && passes)
        r->y->delta = gap;
    r->side = g->side;
    r->pressed = g->pressed;
    find_band(r);
    if (!passes || edge == 0)
        return;
    double jump = 2 * r->excitation->zeta * (damper_acts(r) * r->y->rate - before) / edge;
    r->y->m[2] -= jump * r->y->m[0];
    r->y->m[3] -= jump * r->y->m[1];
    r->y->change[1] -= jump * r->y->change[0];
}

/* Changes the contact. Where the damper begins or ceases to act, the force jumps by `jump` times
   the rate, and the derivatives are multiplied by the saltation matrix [1 0; -jump 1] (Leine &
   Nijmeijer 2004, Dynamics and Bifurcations of Non-Smooth Mechanical Systems). */
static void change_contact(dynamics_run *r, const dynamics_gate *g)
{
    if (g->knee) {
        r->band = g->band;
        return;
    }
    r->band = 0;
    if (r->excitation->film) {
        dynamics_run_release_flank(r);
        return;
    }
    int same_side = g->side == r->side, damped = damper_acts(r);
    if (!same_side && dynamics_tracks_differ(r->excitation)) {
        change_track(r, g);
        return;
    }
    if (!same_side)
        r->y->delta = (g->side ? g->side : r->side) * r->excitation->half_gap;
    r->side = g->side;
    r->pressed = g->pressed;
    if (same_side) {
        find_band(r);
        return;
    }
    double jump = 2 * r->excitation->zeta * (damper_acts(r) - damped);
    r->y->m[2] -= jump * r->y->m[0];
    r->y->m[3] -= jump * r->y->m[1];
    r->y->change[1] -= jump * r->y->change[0];
}

/* Adds the offset of the current line of the spring, as a negative drag. */
static void add_offset(const dynamics_run *r, double since, dynamics_piece_equation *q)
{
    double offset[DYNAMICS_DEGREE + 1];
    dynamics_piece_shift(dynamics_spring_offset(r->piece, r->band), q->degree, since, 1 / r->T,
                         offset);
    for (int i = 0; i <= q->degree; i++)
        q->drag[i] -= dynamics_spring_sign(r->band) * offset[i];
    q->drags = 1;
}

/* Sets the equation of the next step and returns its end, which is at or before the node where the
   equation ceases to be smooth. */
static double plan_step(const dynamics_run *r, dynamics_piece_equation *q)
{
    double end = dynamics_piece_end(r->excitation, r->piece);
    int flies = !r->pressed && r->side == 0;
    if (flies)
        end = r->flow->free_until[r->piece - dynamics_track_of(r->excitation, 0).pieces];
    *q = (dynamics_piece_equation){.load = r->excitation->load,
                                   .damper = damper_acts(r) ? 2 * r->excitation->zeta : 0};
    double since = r->at - r->piece->start;
    q->drags = r->excitation->drags;
    q->degree = r->pressed || q->drags || !is_straight(r->piece) ? r->piece->degree : 1;
    if (r->pressed)
        dynamics_piece_shift(dynamics_spring_slope(r->piece, r->band), q->degree, since, 1 / r->T,
                             q->k);
    if (q->degree > 1 && !is_straight(r->piece))
        dynamics_piece_shift(r->piece->e, q->degree, since, 1 / r->T, q->e);
    if (q->drags)
        dynamics_piece_shift(r->piece->drag, q->degree, since, 1 / r->T, q->drag);
    if (r->pressed && r->band)
        add_offset(r, since, q);
    double left = end - r->at, size = dynamics_taylor_step_size(q, left * r->T);
    if (r->idle > DYNAMICS_MAX_IDLE && left * r->T > dynamics_slip)
        return r->at + dynamics_slip / r->T;
    return size <= dynamics_taylor_longest_step
               ? end
               : r->at + left / ceil(size / dynamics_taylor_longest_step);
}

static void notify_observer(const dynamics_run *r, const dynamics_taylor_series *s, double end,
                            double x, double damper)
{
    dynamics_step stride = {
        .excitation = r->excitation,
        .piece = r->piece,
        .series = s,
        .at = r->at,
        .end = end,
        .x = x,
        .T = r->T,
        .side = r->side,
        .pressed = r->pressed,
        .band = r->band,
        .damper = damper,
    };
    r->observer->observe(r->observer->ctx, &stride);
}

/* Expands the motion up to `end`, or up to an earlier phase where the series converges. Returns
   that phase. */
static double expand(const dynamics_run *r, const dynamics_piece_equation *q, double end,
                     dynamics_taylor_series *s)
{
    enum { HALVINGS = 8 };
    double z[2] = {r->y->delta - r->side * r->excitation->half_gap, r->y->rate};
    s->converged = 0;
    for (int k = 0; k <= HALVINGS && !s->converged; k++) {
        end = k ? r->at + (end - r->at) / 2 : end;
        if (r->variation)
            dynamics_taylor_expand(q, r->T, (end - r->at) * r->T, z, r->y->change, s);
        else
            dynamics_taylor_expand_motion(q, (end - r->at) * r->T, z, s);
    }
    return end;
}

/* Returns the end of a step in free flight that may reach a flank: at most the next node of both
 * flanks. */
static double end_at_nodes(const dynamics_run *r, double end)
{
    for (int side = -1; side <= 1; side += 2) {
        const dynamics_track track = dynamics_track_of(r->excitation, side);
        if (!dynamics_track_holds(track, r->piece))
            end =
                fmin(end, dynamics_piece_end(r->excitation, dynamics_track_piece(track, r->at, 0)));
    }
    return end;
}

static void take_step(dynamics_run *r)
{
    dynamics_piece_equation q;
    dynamics_taylor_series s;
    dynamics_gate g[DYNAMICS_RUN_GATES];
    const dynamics_gate *which = NULL;
    double end = plan_step(r, &q);
    r->end = end = expand(r, &q, end, &s);
    if (!r->side && dynamics_tracks_differ(r->excitation) && !dynamics_run_misses_edge(r, &s, 0)) {
        double node = end_at_nodes(r, end);
        if (node < end)
            r->end = end = expand(r, &q, node, &s);
    }
    double h = (end - r->at) * r->T;
    double x = r->idle > DYNAMICS_MAX_IDLE ? -1 : dynamics_run_find_event(r, &s, g, &which);
    if (x >= 0)
        end = fmin(r->at + x * (end - r->at), end);
    if (r->observer)
        notify_observer(r, &s, end, x >= 0 ? x : 1, q.damper);
    if (x != 0)
        move_state(r, &s, x >= 0 ? x : 1);
    r->idle = x >= 0 && x * h < dynamics_slip ? r->idle + 1 : 0;
    r->at = end;
    if (x >= 0)
        change_contact(r, which);
}

static int follow_cycle(dynamics_run *r)
{
    const dynamics_excitation *excitation = r->excitation;
    const dynamics_piece *last = &excitation->pieces[excitation->count - 1];
    r->piece = last;
    find_contact(r, 1);
    enter_piece(r, r->piece, dynamics_track_with(excitation, r->piece).pieces);
    size_t steps = 0;
    while (r->at < 1) {
        if (r->at >= dynamics_piece_end(excitation, r->piece))
            enter_piece(r, r->piece, r->piece + 1);
        else if (!excitation->film || r->side)
            take_step(r);
        else if (!dynamics_run_step_in_oil(r))
            return 0;
        if (++steps > step_limit)
            return 0;
    }
    if (excitation->film)
        dynamics_run_follow_flanks(r);
    take_track(r, 1, 1); /* the state between cycles is that of the driving flanks */
    return isfinite(r->y->delta) && isfinite(r->y->rate);
}

void dynamics_flow_films(const dynamics_flow *flow, double T, const double x[2], int known,
                         double film[2])
{
    dynamics_state y = dynamics_state_in_oil(x[0], x[1], film);
    dynamics_run r = {.flow = flow, .excitation = flow->excitation, .T = T, .y = &y};
    r.piece = &r.excitation->pieces[r.excitation->count - 1];
    y.oil.known = known;
    find_contact(&r, 1);
    memcpy(film, y.oil.film, sizeof y.oil.film);
}

int dynamics_flow_motion(const dynamics_flow *flow, double T, dynamics_state *state,
                         const dynamics_observer *observer)
{
    dynamics_run r = {
        .flow = flow, .excitation = flow->excitation, .T = T, .y = state, .observer = observer};
    return follow_cycle(&r);
}

int dynamics_flow_variation(const dynamics_flow *flow, double T, dynamics_state *state,
                            const dynamics_observer *observer)
{
    dynamics_run r = {.flow = flow,
                      .excitation = flow->excitation,
                      .T = T,
                      .y = state,
                      .observer = observer,
                      .variation = 1};
    return follow_cycle(&r);
}
