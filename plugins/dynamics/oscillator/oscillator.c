/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "oscillator.h"

#include "../../numerics/bracket.h"
#include "../../numerics/integrator.h"
#include "../excitation/spring.h"
#include "../excitation/tracks.h"

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

struct dynamics_oscillator {
    const dynamics_excitation *excitation;
    numerics_integrator gsl;
    gsl_odeiv2_system system;
    double y[DYNAMICS_STATE_SIZE];
    int side;    /* 1: driving flanks touch, -1: back flanks, 0: neither */
    int pressed; /* 0 with side != 0: the clipped damper holds the flank back behind the teeth,
                    without force */
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

/* A gate is a condition that holds while value >= 0. When it fails, the regime changes to (side,
   pressed); at a knee only the band of the spring changes. */
typedef struct gate {
    double value, rate;
    int side, pressed, knee, band;
} gate;

enum { MOST_GATES = 4 };

/* Returns the slope of the spring force in the current band. */
static double stiffness_at(const dynamics_oscillator *o, double t)
{
    return dynamics_piece_value(dynamics_spring_slope(o->piece, o->band), o->piece->degree,
                                t / o->T);
}

static double stiffness_rate_at(const dynamics_oscillator *o, double t)
{
    return dynamics_piece_slope(dynamics_spring_slope(o->piece, o->band), o->piece->degree,
                                t / o->T) /
           o->T;
}

/* Returns slope times deflection minus the spring force, in the current band. */
static double offset_at(const dynamics_oscillator *o, double t)
{
    return o->band ? dynamics_spring_sign(o->band) *
                         dynamics_piece_value(dynamics_spring_offset(o->piece, o->band),
                                              o->piece->degree, t / o->T)
                   : 0;
}

static double offset_rate_at(const dynamics_oscillator *o, double t)
{
    return o->band ? dynamics_spring_sign(o->band) *
                         dynamics_piece_slope(dynamics_spring_offset(o->piece, o->band),
                                              o->piece->degree, t / o->T) /
                         o->T
                   : 0;
}

static void find_band(dynamics_oscillator *o)
{
    double bend = o->y[DYNAMICS_DELTA] - o->side * o->excitation->half_gap;
    o->band = o->side ? dynamics_spring_band(o->piece, o->t / o->T, bend) : 0;
}

static double error_at(const dynamics_oscillator *o, double t)
{
    return dynamics_piece_value(o->piece->e, o->piece->degree, t / o->T);
}

static double error_rate_at(const dynamics_oscillator *o, double t)
{
    return dynamics_piece_slope(o->piece->e, o->piece->degree, t / o->T) / o->T;
}

static double drag_at(const dynamics_oscillator *o, double t)
{
    return o->excitation->drags ? dynamics_piece_value(o->piece->drag, o->piece->degree, t / o->T)
                                : 0;
}

static double error_bend_at(const dynamics_oscillator *o, double t)
{
    return dynamics_piece_bend(o->piece->e, o->piece->degree, t / o->T) / (o->T * o->T);
}

/* Returns the force that drives delta: load minus drag minus e''. */
static double drive_at(const dynamics_oscillator *o, double t)
{
    return o->excitation->load - drag_at(o, t) - error_bend_at(o, t);
}

static int damper_acts(const dynamics_oscillator *o)
{
    return o->excitation->damping == DYNAMICS_DAMPING_ALWAYS || o->excitation->half_gap == 0 ||
           o->pressed;
}

static double energy_rate_at(const dynamics_oscillator *o, double t, double bend)
{
    return dynamics_spring_at(o->piece, t / o->T, o->T, bend, o->band).energy_rate;
}

/* Evaluates the equation of excitation.h in delta = s - e, its variational equation, and the powers
   of damper and excitation. The power of the excitation excludes that of the drag. */
static int derivative(double t, const double y[], double dydt[], void *self)
{
    const dynamics_oscillator *o = self;
    double k = o->pressed ? stiffness_at(o, t) : 0;
    double c = damper_acts(o) ? 2 * o->excitation->zeta : 0;
    double bend = y[DYNAMICS_DELTA] - o->side * o->excitation->half_gap;
    double force = c * y[DYNAMICS_RATE] + k * bend - (o->pressed ? offset_at(o, t) : 0);
    dydt[DYNAMICS_DELTA] = y[DYNAMICS_RATE];
    dydt[DYNAMICS_RATE] = drive_at(o, t) - force;
    if (o->system.dimension == DYNAMICS_MOTION)
        return GSL_SUCCESS;
    dydt[DYNAMICS_M11] = y[DYNAMICS_M21];
    dydt[DYNAMICS_M12] = y[DYNAMICS_M22];
    dydt[DYNAMICS_M21] = -c * y[DYNAMICS_M21] - k * y[DYNAMICS_M11];
    dydt[DYNAMICS_M22] = -c * y[DYNAMICS_M22] - k * y[DYNAMICS_M12];
    dydt[DYNAMICS_LOSS] = c * y[DYNAMICS_RATE] * y[DYNAMICS_RATE];
    dydt[DYNAMICS_WORK] = (o->pressed ? energy_rate_at(o, t, bend) : 0) -
                          force * error_rate_at(o, t) -
                          drag_at(o, t) * (y[DYNAMICS_RATE] + error_rate_at(o, t));
    return GSL_SUCCESS;
}

dynamics_oscillator *dynamics_oscillator_new(const dynamics_excitation *excitation,
                                             double tolerance, int refine, size_t components)
{
    dynamics_oscillator *o = calloc(1, sizeof *o);
    if (!o)
        return NULL;
    o->excitation = excitation;
    o->refine = refine;
    o->longest = longest_step / refine / sqrt(excitation->k_max);
    o->system = (gsl_odeiv2_system){derivative, NULL, components, o};
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

/* Enters a piece; a mesh cycle lasts T. */
static void enter_piece(dynamics_oscillator *o, const dynamics_piece *piece, double T)
{
    o->piece = piece;
    o->T = T;
    o->cap = fmin(o->longest, piece->length * T / o->refine);
    o->t = 0;
}

/* What delta and its rate change by where another track takes over. */
typedef struct shift {
    const dynamics_piece *piece;
    double since, delta, rate; /* since: phase from the start of the piece */
} shift;

/* Returns the change to the track of a side, at the instant t of the present piece. */
static shift shift_to(const dynamics_oscillator *o, double t, int side)
{
    const dynamics_track track = dynamics_track_of(o->excitation, side);
    shift x = {.piece = o->piece, .since = t / o->T};
    if (dynamics_track_holds(track, o->piece))
        return x;
    double phase = o->piece->start + x.since;
    x.piece = dynamics_track_piece(track, phase, 0);
    x.since = phase - x.piece->start;
    x.delta = error_at(o, t) - dynamics_piece_value(x.piece->e, x.piece->degree, x.since);
    x.rate =
        error_rate_at(o, t) - dynamics_piece_slope(x.piece->e, x.piece->degree, x.since) / o->T;
    return x;
}

/* Goes over to the track of a side; s and s' are continuous. */
static void take_track(dynamics_oscillator *o, int side)
{
    shift x = shift_to(o, o->t, side);
    if (x.piece == o->piece)
        return;
    enter_piece(o, x.piece, o->T);
    o->t = x.since * o->T;
    o->y[DYNAMICS_DELTA] += x.delta;
    o->y[DYNAMICS_RATE] += x.rate;
}

void dynamics_oscillator_start(dynamics_oscillator *o, double T, double delta, double rate)
{
    const dynamics_excitation *excitation = o->excitation;
    const dynamics_piece *last = &excitation->pieces[excitation->count - 1];
    memset(o->y, 0, sizeof o->y);
    o->y[DYNAMICS_DELTA] = delta;
    o->y[DYNAMICS_RATE] = rate;
    o->y[DYNAMICS_M11] = o->y[DYNAMICS_M22] = 1;
    enter_piece(o, last, T);
    o->t = last->length * T;
    o->side = excitation->half_gap == 0 || delta >= excitation->half_gap
                  ? 1
                  : -(delta <= -excitation->half_gap);
    if (o->side <= 0 && dynamics_tracks_differ(excitation))
        o->side = -(delta + shift_to(o, o->t, -1).delta <= -excitation->half_gap);
    o->pressed = o->side != 0;
    find_band(o);
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

double dynamics_oscillator_energy(const dynamics_oscillator *o)
{
    double s = o->y[DYNAMICS_DELTA] + error_at(o, o->t);
    double s_rate = o->y[DYNAMICS_RATE] + error_rate_at(o, o->t);
    double bend = o->pressed ? o->y[DYNAMICS_DELTA] - o->side * o->excitation->half_gap : 0;
    double stored =
        dynamics_spring_at(o->piece, o->t / o->T, o->T, bend, bend != 0 ? o->band : 0).energy;
    return 0.5 * s_rate * s_rate + stored - o->excitation->load * s;
}

/* Crosses a node. s and s' are continuous there, so delta = s - e jumps by minus the jump of e. The
   damper turns a jump of e into an impulse of 2 zeta times that jump. */
static void pass_node(dynamics_oscillator *o, const dynamics_piece *piece, double T)
{
    double before = dynamics_oscillator_energy(o);
    double e = error_at(o, o->t), e_rate = error_rate_at(o, o->t);
    enter_piece(o, piece, T);
    double leap = piece->jump ? piece->e[0] - e : 0;
    o->y[DYNAMICS_DELTA] -= leap;
    o->y[DYNAMICS_RATE] +=
        e_rate - error_rate_at(o, 0) + (damper_acts(o) ? 2 * o->excitation->zeta * leap : 0);
    find_band(o);
    o->y[DYNAMICS_WORK] += dynamics_oscillator_energy(o) - before;
}

/* Lists the gates at which flanks meet or part. Returns their number. */
static int find_contact_gates(const dynamics_oscillator *o, double t, const double *y,
                              gate g[MOST_GATES])
{
    double b = o->excitation->half_gap, sign = o->side;
    if (b == 0)
        return 0;
    if (o->side == 0) {
        g[0] = (gate){.value = b - y[DYNAMICS_DELTA], .rate = -y[DYNAMICS_RATE], .side = 1};
        g[1] = (gate){.value = b + y[DYNAMICS_DELTA], .rate = y[DYNAMICS_RATE], .side = -1};
        g[0].pressed = g[1].pressed = 1;
        for (int i = 0; i < 2 && dynamics_tracks_differ(o->excitation); i++) {
            shift off = shift_to(o, t, g[i].side);
            g[i].value -= g[i].side * off.delta;
            g[i].rate -= g[i].side * off.rate;
        }
        return 2;
    }
    gate touch = {.value = sign * y[DYNAMICS_DELTA] - b, .rate = sign * y[DYNAMICS_RATE]};
    if (o->excitation->damping != DYNAMICS_DAMPING_CLIPPED) {
        g[0] = touch;
        return 1;
    }
    double k = stiffness_at(o, t), c = 2 * o->excitation->zeta;
    double push = k * touch.value + c * touch.rate - sign * offset_at(o, t);
    double bend_rate = sign * (drive_at(o, t) - (o->pressed ? sign * push : 0));
    double push_rate = stiffness_rate_at(o, t) * touch.value + k * touch.rate + c * bend_rate -
                       sign * offset_rate_at(o, t);
    if (o->pressed) {
        g[0] = (gate){.value = push, .rate = push_rate, .side = o->side};
        return 1;
    }
    g[0] = touch;
    g[1] = (gate){.value = -push, .rate = -push_rate, .side = o->side, .pressed = 1};
    return 2;
}

/* Makes the gate at a knee of the spring on one flank. Its value is the force of `line` minus the
   force of the previous line, times `sign`. */
static gate knee_gate(const dynamics_oscillator *o, double t, const double *y, int flank, int line,
                      double sign)
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
    return (gate){.value = sign * dynamics_spring_excess(p, line, since, bend),
                  .rate = sign * rate,
                  .side = o->side,
                  .pressed = o->pressed,
                  .knee = 1,
                  .band = flank * (sign > 0 ? line - 1 : line)};
}

/* Lists the gates of the current regime. Returns their number. */
static int find_gates(const dynamics_oscillator *o, double t, const double *y, gate g[MOST_GATES])
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

/* Returns the value or the rate of gate i after a step of h. */
static double gate_after_step(dynamics_oscillator *o, int i, int rate, double h)
{
    double y[DYNAMICS_STATE_SIZE], error[DYNAMICS_STATE_SIZE];
    gate g[MOST_GATES];
    attempt(o, h, y, error);
    find_gates(o, o->t + h, y, g);
    return rate ? g[i].rate : g[i].value;
}

/* MAX_PROBES: most evaluations; after MAX_SECANTS of them bisection replaces the secant method.
   About 52 halvings of a step reach round-off. */
enum { MAX_PROBES = 100, MAX_SECANTS = 50 };

/* Returns the step at which gate i, or its rate, changes sign between 0 and h. */
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
static int stays_clear(const gate *a, const gate *z, double h)
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

/* Returns the first instant in the step of h at which the value of gate i falls to 0, or -1. A gate
   without a change of sign may still touch 0 in between, so its lowest point is then checked. */
static double find_closing(dynamics_oscillator *o, int i, const gate *a, const gate *z, double h)
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

/* Returns s'' where the tracks of the flanks differ, delta'' where they do not. */
static double acceleration(dynamics_oscillator *o)
{
    double rates[DYNAMICS_STATE_SIZE];
    derivative(o->t, o->y, rates, o);
    return rates[DYNAMICS_RATE] +
           (dynamics_tracks_differ(o->excitation) ? error_bend_at(o, o->t) : 0);
}

/* Multiplies the variation by the saltation matrix 1 + [0 0; jump/rate 0]. It applies where flanks
   meet or separate at the edge of the gap and the force jumps (Leine & Nijmeijer 2004, Dynamics and
   Bifurcations of Non-Smooth Mechanical Systems). `rate` is the rate of the motion relative to that
   edge. */
static void cross_edge(dynamics_oscillator *o, const gate *g)
{
    const int flank = o->side ? o->side : g->side;
    double rate = o->y[DYNAMICS_RATE] + shift_to(o, o->t, flank).rate, before, after;
    if (o->side)
        o->y[DYNAMICS_DELTA] = flank * o->excitation->half_gap;
    before = acceleration(o);
    take_track(o, g->side);
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

/* Changes the regime and adds the change of stored energy to the energy balance. When a flank
   begins to lag behind the teeth, the damper takes the energy of the spring. When e jumps across
   the edge of the gap, the excitation supplies or takes energy. */
static void change_regime(dynamics_oscillator *o, const gate *g)
{
    if (g->knee) {
        o->band = g->band;
        return;
    }
    double b = o->excitation->half_gap, energy = dynamics_oscillator_energy(o);
    double delta = o->y[DYNAMICS_DELTA] + shift_to(o, o->t, o->side ? o->side : g->side).delta;
    int same_side = g->side == o->side;
    if (!same_side && fabs(fabs(delta) - b) < 1e-9 * (1 + b)) {
        cross_edge(o, g);
        return;
    }
    take_track(o, g->side);
    o->side = g->side;
    o->pressed = g->pressed;
    find_band(o);
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
    o->clocks.damped += damper_acts(o) ? h : 0;
}

/* Finds the first event in the step of h to y: its instant and its gate. Returns 0 if there is
   none. */
static int find_event(dynamics_oscillator *o, double h, const double *y, double *at, gate *which)
{
    gate a[MOST_GATES], z[MOST_GATES];
    int count = find_gates(o, o->t, o->y, a), found = 0;
    find_gates(o, o->t + h, y, z);
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
        gate which = {0};
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
        .s = delta + error_at(o, o->t),
        .s_rate = rate + error_rate_at(o, o->t),
        .force = dynamics_mesh_force(o->excitation, o->piece, o->t / o->T, delta, rate),
    };
}

/* Integrates a piece from sample to sample, or until another track takes over. The start of the
 * piece gets a sample if it is `entered` there and the excitation jumps. `next` is the number of
 * the next sample in the cycle. */
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

/* Ends a piece, with a sample where one is due, and enters the next one. 0: the cycle ends. */
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
    take_track(o, o->side);
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
    take_track(o, 1); /* the state between cycles is that of the driving flanks */
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
