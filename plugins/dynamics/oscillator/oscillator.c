/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "oscillator-state.h"

#include "../../numerics/bracket.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Longest step, in radians of the natural frequency of the stiffest mesh. Such a step contains at
   most one turning point. */
static const double longest_step = 0.5;

/* The integration fails after this many steps since the start. */
static const size_t step_limit = 20000000;

/* Smallest error per step, relative to the motion, that may be requested. */
static const double round_off = 1e-14;

/* An event is idle if it comes less than `slip` (rad) after the previous one. After MAX_IDLE idle
   events in a row the regime is kept for that time. */
enum { MAX_IDLE = 4 };
static const double slip = 1e-6;

dynamics_oscillator *dynamics_oscillator_new(const dynamics_excitation *excitation,
                                             double tolerance, int refine, size_t components)
{
    dynamics_oscillator *o = calloc(1, sizeof *o);
    if (!o)
        return NULL;
    o->excitation = excitation;
    o->refine = refine;
    o->longest = longest_step / refine / sqrt(excitation->k_max);
    o->system = (gsl_odeiv2_system){dynamics_oscillator_derivative, NULL, components, o};
    if (numerics_integrator_make(&o->gsl, components, tolerance, round_off))
        return o;
    dynamics_oscillator_free(o);
    return NULL;
}

void dynamics_oscillator_free(dynamics_oscillator *o)
{
    if (!o)
        return;
    numerics_integrator_free(&o->gsl);
    free(o);
}

void dynamics_oscillator_start(dynamics_oscillator *o, double T, double delta, double rate)
{
    const dynamics_excitation *excitation = o->excitation;
    const dynamics_piece *last = &excitation->pieces[excitation->count - 1];
    memset(o->y, 0, sizeof o->y);
    o->y[DYNAMICS_DELTA] = delta;
    o->y[DYNAMICS_RATE] = rate;
    o->y[DYNAMICS_M11] = o->y[DYNAMICS_M22] = 1;
    dynamics_oscillator_enter(o, last, T);
    o->t = last->length * T;
    o->side = excitation->half_gap == 0 || delta >= excitation->half_gap
                  ? 1
                  : -(delta <= -excitation->half_gap);
    if (o->side <= 0 && dynamics_tracks_differ(excitation))
        o->side = -(delta + dynamics_oscillator_shift(o, o->t, -1).delta <= -excitation->half_gap);
    o->pressed = o->side != 0;
    dynamics_oscillator_find_band(o);
    o->clocks = (dynamics_clocks){0};
    o->steps = 0;
}

const double *dynamics_oscillator_state(const dynamics_oscillator *o)
{
    return o->y;
}

dynamics_clocks dynamics_oscillator_clocks(const dynamics_oscillator *o)
{
    return o->clocks;
}

size_t dynamics_oscillator_steps(const dynamics_oscillator *o)
{
    return o->steps;
}

/* Crosses a node. s and s' are continuous there, so delta = s - e jumps by minus the jump of e. The
   damper turns a jump of e into an impulse of 2 zeta times that jump. */
static void pass_node(dynamics_oscillator *o, const dynamics_piece *piece, double T)
{
    double before = dynamics_oscillator_energy(o);
    double e = dynamics_oscillator_error(o, o->t), e_rate = dynamics_oscillator_error_rate(o, o->t);
    dynamics_oscillator_enter(o, piece, T);
    double leap = piece->jump ? piece->e[0] - e : 0;
    o->y[DYNAMICS_DELTA] -= leap;
    o->y[DYNAMICS_RATE] += e_rate - dynamics_oscillator_error_rate(o, 0) +
                           (dynamics_oscillator_is_damped(o) ? 2 * o->excitation->zeta * leap : 0);
    dynamics_oscillator_find_band(o);
    o->y[DYNAMICS_WORK] += dynamics_oscillator_energy(o) - before;
}

/* Tries a step from the current state. `error` is GSL's error estimate for the motion alone: the
   variation obeys the same equation and may grow to any size. */
static void attempt(dynamics_oscillator *o, double h, double *y, double *error)
{
    memcpy(y, o->y, sizeof o->y);
    gsl_odeiv2_step_apply(o->gsl.step, o->t, h, y, error, NULL, NULL, &o->system);
    for (int i = DYNAMICS_MOTION; i < DYNAMICS_STATE_SIZE; i++)
        error[i] = 0;
    o->steps++;
}

/* Returns the value or the rate of dynamics_oscillator_gate i after a step of h. */
static double gate_after_step(dynamics_oscillator *o, int i, int rate, double h)
{
    double y[DYNAMICS_STATE_SIZE], error[DYNAMICS_STATE_SIZE];
    dynamics_oscillator_gate g[DYNAMICS_OSCILLATOR_GATES];
    attempt(o, h, y, error);
    dynamics_oscillator_gates(o, o->t + h, y, g);
    return rate ? g[i].rate : g[i].value;
}

/* MAX_PROBES: largest number of evaluations; after MAX_SECANTS evaluations bisection replaces the
   secant method. About 52 halvings of a step reach round-off. */
enum { MAX_PROBES = 100, MAX_SECANTS = 50 };

/* Returns the step at which dynamics_oscillator_gate i, or its rate, changes sign between 0 and h.
 */
static double find_change(dynamics_oscillator *o, int i, int rate, double at_0, double h,
                          double at_h)
{
    numerics_bracket b = {0, at_0, h, at_h, 0};
    double small = 4 * DBL_EPSILON * (fabs(at_0) + fabs(at_h));
    for (int n = 0; n < MAX_PROBES && b.high - b.low > 4 * DBL_EPSILON * h; n++) {
        double middle = numerics_bracket_secant(&b);
        if (!(middle > b.low && middle < b.high) || n > MAX_SECANTS)
            middle = b.low + 0.5 * (b.high - b.low);
        double f = gate_after_step(o, i, rate, middle);
        if (fabs(f) <= small)
            return middle;
        numerics_bracket_narrow(&b, middle, f);
    }
    return b.high;
}

/* Returns whether the cubic through two values and rates stays above 0 between them. */
static int stays_clear(const dynamics_oscillator_gate *a, const dynamics_oscillator_gate *z,
                       double h)
{
    double slope = (z->value - a->value) / h;
    double c2 = (3 * slope - 2 * a->rate - z->rate) / h;
    double c3 = (a->rate + z->rate - 2 * slope) / (h * h);
    double root = sqrt(fmax(c2 * c2 - 3 * c3 * a->rate, 0));
    double x = -a->rate / (c2 + root); /* position of the minimum, where the rate changes sign to
                                          positive */
    if (!(x > 0 && x < h))
        return 0;
    double lowest = a->value + x * (a->rate + x * (c2 + x * c3));
    return lowest > 0.1 * (fmin(a->value, z->value) - lowest);
}

/* Returns the first instant in the step of h at which the value of dynamics_oscillator_gate i falls
   to 0, or -1. If the sign of the gate does not change, the gate may still touch 0 in between, so
   its minimum is checked. */
static double find_closing(dynamics_oscillator *o, int i, const dynamics_oscillator_gate *a,
                           const dynamics_oscillator_gate *z, double h)
{
    double tiny = 100 * DBL_EPSILON * (1 + o->excitation->half_gap);
    if (a->value < -tiny || (a->value < 0 && a->rate < 0))
        return 0;
    double start = fmax(a->value, 0);
    if (z->value < 0)
        return start == 0 && a->rate <= 0 ? 0 : find_change(o, i, 0, start, h, z->value);
    if (!(a->rate < 0 && z->rate > 0) || stays_clear(a, z, h))
        return -1;
    double lowest = find_change(o, i, 1, a->rate, h, z->rate);
    double value = gate_after_step(o, i, 0, lowest);
    return value < -tiny ? find_change(o, i, 0, start, lowest, value) : -1;
}

/* Returns s'' if the flanks have different tracks, otherwise delta''. */
static double acceleration(dynamics_oscillator *o)
{
    double rates[DYNAMICS_STATE_SIZE];
    dynamics_oscillator_derivative(o->t, o->y, rates, o);
    return rates[DYNAMICS_RATE] +
           (dynamics_tracks_differ(o->excitation) ? dynamics_oscillator_error_bend(o, o->t) : 0);
}

/* Multiplies the variation by the saltation matrix 1 + [0 0; jump/rate 0]. It applies where flanks
   meet or separate at the edge of the gap and the force jumps (Leine & Nijmeijer 2004, Dynamics and
   Bifurcations of Non-Smooth Mechanical Systems). `rate` is the rate of the motion relative to that
   edge. */
static void cross_edge(dynamics_oscillator *o, const dynamics_oscillator_gate *g)
{
    const int flank = o->side ? o->side : g->side;
    double rate = o->y[DYNAMICS_RATE] + dynamics_oscillator_shift(o, o->t, flank).rate, before,
           after;
    if (o->side)
        o->y[DYNAMICS_DELTA] = flank * o->excitation->half_gap;
    before = acceleration(o);
    dynamics_oscillator_take_track(o, g->side);
    if (!o->side)
        o->y[DYNAMICS_DELTA] = flank * o->excitation->half_gap;
    o->side = g->side;
    o->band = 0;
    o->pressed = g->pressed;
    after = acceleration(o);
    double salt = rate != 0 ? (after - before) / rate : 0;
    o->y[DYNAMICS_M21] += salt * o->y[DYNAMICS_M11];
    o->y[DYNAMICS_M22] += salt * o->y[DYNAMICS_M12];
}

/* Changes the regime and adds the change of stored energy to the energy balance. When a clipped
   damper begins to limit the speed of a flank, the damper takes the energy of the spring. When e
   jumps across the edge of the gap, the excitation supplies or takes energy. */
static void change_regime(dynamics_oscillator *o, const dynamics_oscillator_gate *g)
{
    if (g->knee) {
        o->band = g->band;
        return;
    }
    double b = o->excitation->half_gap, energy = dynamics_oscillator_energy(o);
    double delta = o->y[DYNAMICS_DELTA] +
                   dynamics_oscillator_shift(o, o->t, o->side ? o->side : g->side).delta;
    int same_side = g->side == o->side;
    if (!same_side && fabs(fabs(delta) - b) < 1e-9 * (1 + b)) {
        cross_edge(o, g);
        return;
    }
    dynamics_oscillator_take_track(o, g->side);
    o->side = g->side;
    o->pressed = g->pressed;
    dynamics_oscillator_find_band(o);
    double change = dynamics_oscillator_energy(o) - energy;
    if (same_side)
        o->y[DYNAMICS_LOSS] -= change;
    else
        o->y[DYNAMICS_WORK] += change;
}

static void accept_step(dynamics_oscillator *o, double h, const double *y)
{
    memcpy(o->y, y, sizeof o->y);
    if (o->pressed && o->band)
        o->y[DYNAMICS_WORK] += dynamics_spring_knee_energy(o->piece, (o->t + h) / o->T, o->band) -
                               dynamics_spring_knee_energy(o->piece, o->t / o->T, o->band);
    o->t += h;
    o->clocks.parted += o->pressed ? 0 : h;
    o->clocks.back += o->pressed && o->side < 0 ? h : 0;
    o->clocks.damped += dynamics_oscillator_is_damped(o) ? h : 0;
}

/* Finds the first event in the step of h to y: its instant and its gate. Returns 0 if there is
   none. */
static int find_event(dynamics_oscillator *o, double h, const double *y, double *at,
                      dynamics_oscillator_gate *which)
{
    dynamics_oscillator_gate a[DYNAMICS_OSCILLATOR_GATES], z[DYNAMICS_OSCILLATOR_GATES];
    int count = dynamics_oscillator_gates(o, o->t, o->y, a), found = 0;
    dynamics_oscillator_gates(o, o->t + h, y, z);
    for (int i = 0; i < count; i++) {
        double instant = find_closing(o, i, &a[i], &z[i], h);
        if (instant < 0 || (found && instant >= *at))
            continue;
        *at = instant;
        *which = a[i];
        found = 1;
    }
    return found;
}

/* Integrates to the instant `end` of the piece, or until the motion changes to another track.
   Returns 0 if there are too many steps. */
static int advance_to(dynamics_oscillator *o, double end)
{
    static const double no_slope[DYNAMICS_STATE_SIZE] = {0};
    const dynamics_piece *piece = o->piece;
    double y[DYNAMICS_STATE_SIZE], error[DYNAMICS_STATE_SIZE];
    int idle = 0;
    while (o->t < end) {
        if (o->steps > step_limit)
            return 0;
        double h = fmin(o->h, o->cap), left = end - o->t, at = 0;
        if (idle >= MAX_IDLE)
            h = fmin(h, slip);
        int last = h >= left * (1 - 1e-9);
        h = last ? left : fmin(h, 0.5 * left + 0.5 * h);
        dynamics_oscillator_gate which = {0};
        attempt(o, h, y, error);
        double next = h;
        int adjusted =
            gsl_odeiv2_control_hadjust(o->gsl.control, o->gsl.step, y, error, no_slope, &next);
        if (adjusted == GSL_ODEIV_HADJ_DEC && h > 1e-9) {
            o->h = next;
            continue;
        }
        if (idle < MAX_IDLE && find_event(o, h, y, &at, &which)) {
            if (at > 0)
                attempt(o, at, y, error), accept_step(o, at, y);
            idle = at > slip ? 0 : idle + 1;
            change_regime(o, &which);
            if (o->piece != piece)
                return 1;
            continue;
        }
        accept_step(o, h, y);
        idle = 0;
        o->h = adjusted == GSL_ODEIV_HADJ_INC ? fmax(o->h, next) : o->h;
        if (last)
            o->t = end;
    }
    return 1;
}

static void add_sample(const dynamics_oscillator *o, double phase, dynamics_record *record)
{
    if (record->count == record->capacity)
        return;
    double delta = o->y[DYNAMICS_DELTA], rate = o->y[DYNAMICS_RATE];
    record->samples[record->count++] = (dynamics_sample){
        .phase = (double)record->cycles + phase,
        .s = delta + dynamics_oscillator_error(o, o->t),
        .s_rate = rate + dynamics_oscillator_error_rate(o, o->t),
        .force = dynamics_mesh_force(o->excitation, o->piece, o->t / o->T, delta, rate),
    };
}

/* Integrates a piece from sample to sample, or until the motion changes to another track. The start
 * of the piece gets a sample if it is `entered` there and the excitation jumps. `next` is the
 * number of the next sample in the cycle. */
static int record_piece(dynamics_oscillator *o, const dynamics_piece *piece, int entered,
                        size_t *next, dynamics_record *record)
{
    double n = (double)record->per_cycle, end = piece->start + piece->length, T = o->T;
    for (; (double)*next / n <= piece->start + 1e-12; ++*next)
        ;
    if (entered && (piece->jump || (piece->start == 0 && record->cycles == 0)))
        add_sample(o, piece->start, record);
    for (; (double)*next / n < end - 1e-12; ++*next) {
        double phase = (double)*next / n;
        if (!advance_to(o, (phase - piece->start) * T))
            return 0;
        if (o->piece != piece)
            return 1;
        add_sample(o, phase, record);
    }
    return advance_to(o, piece->length * T);
}

/* Ends a piece, with a sample if one is due there, and enters the next piece. Returns 0 if the
   cycle ends. */
static int leave_piece(dynamics_oscillator *o, dynamics_record *record)
{
    const dynamics_track track = dynamics_track_with(o->excitation, o->piece);
    const size_t i = (size_t)(o->piece - track.pieces);
    const int final = i + 1 == track.count, jump = track.pieces[(i + 1) % track.count].jump;
    double end = final ? 1 : o->piece->start + o->piece->length;
    double node = end * (record ? (double)record->per_cycle : 0);
    if (record && (jump || final || fabs(node - round(node)) < 1e-9))
        add_sample(o, end, record);
    if (!final)
        pass_node(o, o->piece + 1, o->T);
    return !final;
}

int dynamics_oscillator_cycle(dynamics_oscillator *o, double T, dynamics_record *record)
{
    size_t next = 0;
    int entered = 1, on = 1;
    o->h = o->longest;
    dynamics_oscillator_take_track(o, o->side);
    pass_node(o, dynamics_track_with(o->excitation, o->piece).pieces, T);
    while (on) {
        const dynamics_piece *piece = o->piece;
        if (!(record ? record_piece(o, piece, entered, &next, record)
                     : advance_to(o, piece->length * T)))
            return 0;
        entered = o->piece == piece;
        if (entered)
            on = leave_piece(o, record);
    }
    dynamics_oscillator_take_track(o,
                                   1); /* the state between cycles is that of the driving flanks */
    if (record)
        record->cycles++;
    return 1;
}

int dynamics_record_init(dynamics_record *record, const dynamics_excitation *excitation,
                         size_t per_cycle, size_t cycles)
{
    const size_t pieces = excitation->count + excitation->back.count + excitation->flight.count;
    size_t capacity = (per_cycle + 2 + 2 * pieces) * cycles;
    *record = (dynamics_record){.per_cycle = per_cycle, .capacity = capacity};
    record->samples = malloc(capacity * sizeof *record->samples);
    return record->samples != NULL;
}

void dynamics_record_free(dynamics_record *record)
{
    free(record->samples);
    record->samples = NULL;
}
