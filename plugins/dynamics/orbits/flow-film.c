/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrates a motion with oil between the flanks. */
#include "flow-run.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Longest and shortest step of a motion in oil, in radians of the natural frequency. */
static const double longest = 0.5, shortest = 1e-14;

static double sign_of(int flank)
{
    return flank ? -1 : 1;
}

static double overlap(const dynamics_run *r, int flank)
{
    return sign_of(flank) * r->y->delta - r->excitation->half_gap;
}

/* Sets each film without load from the position of the flanks: y = 0 (hand-over thickness) on a
   flank that is held, and the whole gap on the other flank. At the start of a motion this
   overwrites given films. */
void dynamics_run_follow_flanks(dynamics_run *r)
{
    dynamics_film_state *oil = &r->y->oil;
    for (int f = 0; f < 2; f++) {
        double s = sign_of(f);
        int held = r->side == (f ? -1 : 1);
        if (!held && r->open[f])
            continue;
        s = held ? 0 : -s;
        oil->film[f] = held ? 0 : -overlap(r, f);
        for (int c = 0; c < 2; c++) {
            oil->m[f][c] = s * r->y->m[c];
            oil->m[f][2 + c] = s * oil->by[c];
        }
        oil->change[f] = s * r->y->change[0];
    }
}

static int is_filled(const dynamics_run *r, int flank)
{
    const dynamics_film *film = r->excitation->film;
    return film->hand_over - overlap(r, flank) < film->supply;
}

/* Starts the film of a flank that begins to carry load, at its quasi-static thickness. */
static void open_film(dynamics_run *r, int flank)
{
    const dynamics_film *film = r->excitation->film;
    dynamics_film_place place = dynamics_film_at(film, r->at, r->T);
    r->open[flank] = 1;
    r->y->oil.film[flank] = dynamics_film_quasi_static(
        film, &place, fmax(r->side || r->at > 0 ? dynamics_run_stiffness(r) : r->piece->k[0], 1e-3),
        overlap(r, flank), sign_of(flank) * r->y->rate);
}

void dynamics_run_find_films(dynamics_run *r)
{
    const dynamics_film *film = r->excitation->film;
    dynamics_film_state *oil = &r->y->oil;
    int known = oil->known;
    r->side = 0;
    for (int f = 0; f < 2; f++) {
        double q = overlap(r, f);
        if (r->side == 0 && (known ? oil->film[f] <= 0 && q > 0 : q >= 0))
            r->side = f ? -1 : 1;
    }
    for (int f = 0; f < 2; f++) {
        double bend = overlap(r, f) + oil->film[f], s = sign_of(f);
        r->open[f] = 0;
        if (r->side || !is_filled(r, f))
            continue;
        if (!known || (film->rolling && bend <= 0))
            open_film(r, f);
        else
            r->open[f] = film->rolling || bend > 0 || s * r->y->rate > 0;
        if (r->open[f] && !film->rolling && overlap(r, f) + oil->film[f] <= 0 &&
            !(s * r->y->rate > 0))
            r->open[f] = 0;
    }
    oil->known = 1;
    r->pressed = r->side != 0;
    dynamics_run_follow_flanks(r);
}

/* Multiplies the derivatives by a saltation matrix, as in flow.c, for a force on the gears that
   jumps by `force`. If delta changes by d, the event occurs earlier or later by -share d. */
static void salt(dynamics_run *r, double force, double share)
{
    dynamics_state *y = r->y;
    for (int c = 0; c < 2; c++) {
        y->m[2 + c] += force * share * y->m[c];
        y->oil.by[2 + c] += force * share * y->oil.by[c];
    }
    y->change[1] += force * share * y->change[0];
}

/* When a flank is released, applies the force of the film on the opposite flank as a step, since
   that film was not integrated before. */
static void jump_in(dynamics_run *r, int flank)
{
    double s = -sign_of(flank), k = dynamics_run_stiffness(r),
           k_rate =
               dynamics_piece_slope(r->piece->k, r->piece->degree, r->at - r->piece->start) / r->T;
    double load_rate = s * k * r->y->rate + k_rate * overlap(r, !flank);
    double W = k * (overlap(r, flank) + r->y->oil.film[flank]);
    if (load_rate != 0)
        salt(r, s * W, s * k / load_rate);
}

void dynamics_run_release_flank(dynamics_run *r)
{
    const dynamics_film *film = r->excitation->film;
    int flank = r->side < 0, other = !flank;
    r->side = r->pressed = 0;
    r->open[flank] = film->rolling;
    r->open[other] = 0;
    if (is_filled(r, other) && (film->rolling || sign_of(other) * r->y->rate > 0)) {
        open_film(r, other);
        jump_in(r, other);
    }
    dynamics_run_follow_flanks(r);
    if (!r->open[other])
        return;
    for (int c = 0; c < 2; c++) {
        r->y->oil.m[other][c] = -sign_of(other) * r->y->m[c];
        r->y->oil.m[other][2 + c] = -sign_of(other) * r->y->oil.by[c];
    }
    r->y->oil.change[other] = -sign_of(other) * r->y->change[0];
}

void dynamics_run_holding_load(const dynamics_run *r, double end, double load[2])
{
    const dynamics_film *film = r->excitation->film;
    dynamics_film_place at = dynamics_film_at(film, r->at, r->T);
    dynamics_film_place before = dynamics_film_at(film, end - 1e-12, r->T);
    load[0] = dynamics_film_holding_load(film, &at);
    load[1] = dynamics_film_holding_load(film, &before) - load[0];
}

void dynamics_run_carry_films(dynamics_run *r, const double v[2], const double w[2])
{
    double *by = r->y->oil.by, old[4];
    memcpy(old, by, sizeof old);
    for (int c = 0; c < 2; c++) {
        by[c] = v[0] * old[c] + v[1] * old[2 + c];
        by[2 + c] = w[0] * old[c] + w[1] * old[2 + c];
    }
    dynamics_run_follow_flanks(r);
}

/* Kinds of gates. If the value becomes negative, the film has fallen to the hand-over thickness
   (HELD), the film stops carrying load (FREE), the flank begins to approach (CLOSING), or the gap
   passes the thickness up to which oil fills it (FILLED). */
enum { HELD, FREE, CLOSING, FILLED };

typedef struct oil_gate {
    int flank, change;
} oil_gate;

static void gate_values(const dynamics_run *r, const dynamics_landing *step, oil_gate g, double *v)
{
    const dynamics_film *film = r->excitation->film;
    double s = sign_of(g.flank), inside = is_filled(r, g.flank) ? 1 : -1;
    for (int i = 0; i < DYNAMICS_NODES; i++)
        switch (g.change) {
        case HELD:
            v[i] = step->film[g.flank][i];
            break;
        case FREE:
            v[i] = step->bend[g.flank][i];
            break;
        case CLOSING:
            v[i] = -s * step->rate[i];
            break;
        default:
            v[i] = inside * (film->supply - film->hand_over - step->film[g.flank][i]);
        }
}

static int list_gates(const dynamics_run *r, oil_gate g[8])
{
    const dynamics_film *film = r->excitation->film;
    int count = 0;
    for (int f = 0; f < 2; f++) {
        if (r->open[f])
            g[count++] = (oil_gate){f, HELD};
        if (r->open[f] && !film->rolling)
            g[count++] = (oil_gate){f, FREE};
        if (!r->open[f] && is_filled(r, f))
            g[count++] = (oil_gate){f, CLOSING};
        if (isfinite(film->supply))
            g[count++] = (oil_gate){f, FILLED};
    }
    return count;
}

/* Removes the film on the opposite flank when a flank lands, since that film is then no longer
   integrated. */
static void jump_out(dynamics_run *r, int flank)
{
    const dynamics_film *film = r->excitation->film;
    dynamics_state *y = r->y;
    double k = dynamics_run_stiffness(r), s = sign_of(!flank);
    dynamics_film_place place = dynamics_film_at(film, fmax(r->at - 1e-12, 0), r->T);
    double speed =
        dynamics_film_approach(film, &place, k * overlap(r, flank), film->hand_over).speed;
    if (!r->open[!flank] || !(speed > 0))
        return;
    double force = s * k * (overlap(r, !flank) + y->oil.film[!flank]) / -speed;
    for (int c = 0; c < 2; c++) {
        y->m[2 + c] += force * y->oil.m[flank][c];
        y->oil.by[2 + c] += force * y->oil.m[flank][2 + c];
    }
    y->change[1] += force * y->oil.change[flank];
}

static void pass_gate(dynamics_run *r, oil_gate g)
{
    dynamics_film_state *oil = &r->y->oil;
    if (g.change == HELD) {
        jump_out(r, g.flank);
        r->side = g.flank ? -1 : 1;
        r->open[0] = r->open[1] = 0;
    } else if (g.change == FREE) {
        r->open[g.flank] = 0;
    } else if (g.change == CLOSING) {
        r->open[g.flank] = 1;
    } else if (r->open[g.flank]) {
        r->open[g.flank] = 0;
        r->y->delta -= 4 * DBL_EPSILON * sign_of(g.flank) * (1 + r->excitation->half_gap);
    } else {
        r->y->delta += 4 * DBL_EPSILON * sign_of(g.flank) * (1 + r->excitation->half_gap);
        if (r->excitation->film->rolling)
            open_film(r, g.flank);
        else
            r->open[g.flank] = sign_of(g.flank) * r->y->rate > 0;
        for (int c = 0; c < 4; c++)
            oil->m[g.flank][c] = 0;
        oil->change[g.flank] = 0;
    }
    r->pressed = r->side != 0;
    dynamics_run_follow_flanks(r);
}

/* Solves a step from the current state to the phase `end`. Returns 0 if there is no solution. */
static int solve_step(const dynamics_run *r, double end, dynamics_landing *step)
{
    *step = (dynamics_landing){.excitation = r->excitation,
                               .piece = r->piece,
                               .at = r->at,
                               .end = end,
                               .T = r->T,
                               .open = {r->open[0], r->open[1]}};
    step->delta[0] = r->y->delta;
    step->rate[0] = r->y->rate;
    for (int f = 0; f < 2; f++) {
        step->film[f][0] = r->y->oil.film[f];
        step->bend[f][0] = r->open[f] ? overlap(r, f) + r->y->oil.film[f] : 0;
        step->force[0] += sign_of(f) * dynamics_run_stiffness(r) * step->bend[f][0];
    }
    return dynamics_landing_solve(r->flow->radau, step);
}

/* Solves the longest step that is accurate enough and ends at or before the next node. Returns 0 if
   none was found. */
static int find_step(dynamics_run *r, dynamics_landing *step)
{
    double node = dynamics_film_node(r->excitation->film, r->at),
           end = dynamics_piece_end(r->excitation, r->piece);
    if (node > r->at && node < end)
        end = node;
    double left = (end - r->at) * r->T;
    double h = r->stride > 0 ? fmin(r->stride, longest) : 0.01;
    if (r->idle > DYNAMICS_MAX_IDLE)
        h = dynamics_slip;
    for (;; h *= 0.5) {
        int last = h >= left * (1 - 1e-9);
        double to = last ? end : r->at + fmin(h, 0.5 * (left + h)) / r->T;
        if (h < shortest && !last)
            return 0;
        if (!solve_step(r, to, step))
            continue;
        double used = (to - r->at) * r->T;
        double change = 0.8 * pow(fmax(step->doubt, 1e-6), -1. / DYNAMICS_STAGES);
        if (step->doubt > 1 && used > shortest) {
            h = fmin(2 * used * fmax(change, 0.1), 1.9 * used); /* the loop halves h */
            continue;
        }
        if (r->idle <= DYNAMICS_MAX_IDLE)
            r->stride = last ? fmax(r->stride, used * fmin(change, 4)) : used * fmin(change, 4);
        return 1;
    }
}

/* Finds the first gate whose value becomes negative within the step. Returns the fraction of the
   step at which this happens, or -1 if it does not happen. */
static double first_gate(const dynamics_run *r, const dynamics_landing *step, oil_gate *which)
{
    double first = -1, tiny = 8 * DBL_EPSILON * (1 + r->excitation->half_gap);
    double value[DYNAMICS_NODES], power[DYNAMICS_NODES];
    oil_gate gates[8];
    int count = list_gates(r, gates);
    for (int i = 0; i < count; i++) {
        gate_values(r, step, gates[i], value);
        dynamics_landing_polynomial(r->flow->radau, value, power);
        double x = dynamics_taylor_first_exit(power, DYNAMICS_STAGES, tiny);
        if (x < 0 || (first >= 0 && x >= first))
            continue;
        first = x;
        *which = gates[i];
    }
    return first;
}

/* Shortens the step until it ends where the gate closes. The polynomials are less accurate inside a
   step than at its end. */
static void end_at_gate(const dynamics_run *r, oil_gate g, double x, dynamics_landing *step)
{
    double value[DYNAMICS_NODES], power[DYNAMICS_NODES], at = x * (step->end - step->at);
    double tiny = DBL_EPSILON * (1 + r->excitation->half_gap);
    for (int i = 0; i < 6; i++) {
        dynamics_landing shorter;
        if (!(at > 0) || !solve_step(r, r->at + at, &shorter))
            return;
        *step = shorter;
        gate_values(r, step, g, value);
        double now = value[DYNAMICS_STAGES], slope = 0;
        dynamics_landing_polynomial(r->flow->radau, value, power);
        for (int n = 1; n < DYNAMICS_NODES; n++)
            slope += n * power[n];
        double next = at - now / slope * at;
        if (fabs(now) <= tiny || !(slope < 0) || !(next > 0.5 * at && next < 2 * at) ||
            r->at + next > dynamics_piece_end(r->excitation, r->piece))
            return;
        at = next;
    }
}

static void vary_state(dynamics_run *r, const dynamics_landing *step)
{
    dynamics_state *y = r->y;
    double column[DYNAMICS_FILM_COLUMNS][DYNAMICS_FILM_ROWS];
    for (int c = 0; c < 4; c++) {
        column[c][0] = c < 2 ? y->m[c] : y->oil.by[c - 2];
        column[c][1] = c < 2 ? y->m[2 + c] : y->oil.by[c];
        column[c][2] = y->oil.m[0][c];
        column[c][3] = y->oil.m[1][c];
    }
    column[4][0] = y->change[0];
    column[4][1] = y->change[1];
    column[4][2] = y->oil.change[0];
    column[4][3] = y->oil.change[1];
    dynamics_landing_vary(r->flow->radau, step, column);
    for (int c = 0; c < 4; c++) {
        *(c < 2 ? &y->m[c] : &y->oil.by[c - 2]) = column[c][0];
        *(c < 2 ? &y->m[2 + c] : &y->oil.by[c]) = column[c][1];
        y->oil.m[0][c] = column[c][2];
        y->oil.m[1][c] = column[c][3];
    }
    y->change[0] = column[4][0];
    y->change[1] = column[4][1];
    y->oil.change[0] = column[4][2];
    y->oil.change[1] = column[4][3];
}

/* Passes the step to the observer, with delta as the integral of its rate. The values of the rate
   at the nodes have a higher order. */
static void notify(const dynamics_run *r, const dynamics_landing *step)
{
    dynamics_taylor_series s = {.order = DYNAMICS_NODES, .h = (step->end - step->at) * r->T};
    double power[DYNAMICS_NODES];
    dynamics_landing_polynomial(r->flow->radau, step->rate, power);
    s.c[0][DYNAMICS_Z] = step->delta[0];
    for (int n = 0; n < DYNAMICS_NODES; n++)
        s.c[n + 1][DYNAMICS_Z] = s.h * power[n] / (n + 1);
    dynamics_step stride = {.excitation = r->excitation,
                            .piece = r->piece,
                            .series = &s,
                            .at = step->at,
                            .end = step->end,
                            .x = 1,
                            .T = r->T,
                            .damper = 2 * r->excitation->zeta,
                            .landing = step};
    r->observer->observe(r->observer->ctx, &stride);
}

int dynamics_run_step_in_oil(dynamics_run *r)
{
    dynamics_landing step;
    oil_gate which = {0, 0};
    if (!find_step(r, &step))
        return 0;
    double x = r->idle > DYNAMICS_MAX_IDLE ? -1 : first_gate(r, &step, &which);
    if (x > 0)
        end_at_gate(r, which, x, &step);
    double h = (step.end - step.at) * r->T;
    if (x != 0) {
        if (r->observer)
            notify(r, &step);
        if (r->variation)
            vary_state(r, &step);
        r->y->delta = step.delta[DYNAMICS_STAGES];
        r->y->rate = step.rate[DYNAMICS_STAGES];
        for (int f = 0; f < 2; f++)
            r->y->oil.film[f] = step.film[f][DYNAMICS_STAGES];
        r->at = step.end;
        dynamics_run_follow_flanks(r);
    }
    r->idle = x >= 0 && (x == 0 || h < dynamics_slip) ? r->idle + 1 : 0;
    if (x >= 0)
        pass_gate(r, which);
    return 1;
}
