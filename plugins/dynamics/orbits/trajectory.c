/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "trajectory.h"

#include "../excitation/spring.h"
#include "../excitation/tracks.h"
#include "orbit-film.h"

#include <math.h>
#include <string.h>

/* Nodes and weights of the 8-point Gauss-Legendre rule on [-1, 1] (Abramowitz & Stegun 1964, table
   25.4). The rule is exact up to degree 15. A step is at most 1.5 rad long, so its error is about
   1e-15. */
enum { NODES = 8 };
static const double node[NODES / 2] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                       0.9602898564975363};
static const double weight[NODES / 2] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};

/* The motion at x h after the start of a step. */
typedef struct moment {
    double delta, rate, e, e_rate;
    dynamics_spring spring; /* 0 if no flank is pressed */
    double drag, film_rate;
} moment;

/* Sets the energy at one end of a step in which no flank is held. The films then deflect the teeth
   of both flanks, so that two springs may store energy. Inside the step this energy is not
   computed. */
static void bend_in_oil(const dynamics_step *f, double x, double phase, moment *m)
{
    const dynamics_landing *step = f->landing;
    int i = x > 0.5 ? DYNAMICS_STAGES : 0;
    double bend = hypot(step->bend[0][i], step->bend[1][i]);
    m->spring = dynamics_spring_at(f->piece, phase, f->T, bend, 0);
}

/* Returns the phase since the start of the piece. */
static double phase_at(const dynamics_step *f, double x)
{
    return f->at + (f->end - f->at) * (f->x > 0 ? x / f->x : 0) - f->piece->start;
}

static moment moment_at(const dynamics_step *f, double x)
{
    double z[2], phase = phase_at(f, x);
    dynamics_taylor_at(f->series, DYNAMICS_Z, x, z);
    moment m = {
        .delta = z[0] + f->side * f->excitation->half_gap,
        .rate = z[1],
        .e = dynamics_piece_value(f->piece->e, f->piece->degree, phase),
        .e_rate = dynamics_piece_slope(f->piece->e, f->piece->degree, phase) / f->T,
    };
    if (f->pressed)
        m.spring = dynamics_spring_at(f->piece, phase, f->T, z[0], f->band);
    if (f->landing)
        bend_in_oil(f, x, phase, &m);
    if (f->excitation->drags) {
        m.drag = dynamics_piece_value(f->piece->drag, f->piece->degree, phase);
        m.film_rate = dynamics_piece_slope(f->piece->film, f->piece->degree, phase) / f->T;
    }
    return m;
}

static double energy_of(const dynamics_excitation *excitation, const moment *m)
{
    double s_rate = m->rate + m->e_rate;
    return 0.5 * s_rate * s_rate + m->spring.energy - excitation->load * (m->delta + m->e);
}

void dynamics_trajectory_observe_moments(void *self, const dynamics_step *f)
{
    dynamics_trajectory *t = self;
    double half = 0.5 * f->x, h = half * f->series->h;
    for (int i = 0; i < NODES; i++) {
        double w = h * weight[i / 2], x = half * (1 + (i % 2 ? node[i / 2] : -node[i / 2])), z = 0;
        for (int n = f->series->order; n >= 0; n--)
            z = z * x + f->series->c[n][DYNAMICS_Z];
        double s = z + f->side * f->excitation->half_gap +
                   dynamics_piece_value(f->piece->e, f->piece->degree, phase_at(f, x)) - t->origin;
        t->sum += w * s;
        t->square += w * s * s;
    }
}

/* Adds the change of energy between two steps to the balance. At a node the excitation does work.
   When a clipped contact opens, the damper takes the energy stored in the spring. Nothing else
   changes the energy. */
static void join_strides(dynamics_trajectory *t, const dynamics_step *f)
{
    moment m = moment_at(f, 0);
    double energy = energy_of(f->excitation, &m), change = energy - t->energy;
    const dynamics_piece *track = dynamics_track_with(f->excitation, f->piece).pieces;
    if (!t->begun)
        t->start = energy;
    else if (f->side == t->side && f->pressed != t->pressed)
        t->loss -= change;
    else if (f->excitation->film &&
             f->side != t->side) /* a film on the opposite flank begins or ceases to carry load */
        t->loss -= change;
    else if (f->at == f->piece->start || track != t->track) /* e may jump across a flank */
        t->work += change;
    t->begun = 1;
    t->track = track;
    t->side = f->side;
    t->pressed = f->pressed;
}

static void add_powers(dynamics_trajectory *t, const dynamics_step *f)
{
    double half = 0.5 * f->x, h = half * f->series->h;
    for (int i = 0; i < NODES && !f->landing; i++) {
        double w = h * weight[i / 2];
        moment m = moment_at(f, half * (1 + (i % 2 ? node[i / 2] : -node[i / 2])));
        double force = f->damper * m.rate + m.spring.force;
        t->loss += w * f->damper * m.rate * m.rate;
        t->work += w * (m.spring.energy_rate - force * m.e_rate);
        t->drag += w * m.drag * (m.rate + m.e_rate);
        t->thickness += w * force * m.film_rate;
    }
    if (f->pressed)
        t->work += dynamics_spring_knee_energy(f->piece, phase_at(f, f->x), f->band) -
                   dynamics_spring_knee_energy(f->piece, phase_at(f, 0), f->band);
    if (f->landing) {
        dynamics_landing_energy sum = dynamics_landing_energies(t->radau, f->landing);
        t->loss += sum.damper + sum.films;
        t->films += sum.films;
        t->work += sum.work;
        t->drag += sum.drag;
        t->thickness += sum.thickness;
    }
    moment end = moment_at(f, f->x);
    t->energy = energy_of(f->excitation, &end);
}

static double value_in_oil(const dynamics_radau *radau, const double *nodes, double x)
{
    double power[DYNAMICS_NODES], value = 0;
    dynamics_landing_polynomial(radau, nodes, power);
    for (int n = DYNAMICS_NODES; n-- > 0;)
        value = value * x + power[n];
    return value;
}

/* Returns the film on the driving flank beyond the thickness at hand-over (theory, eq. 4.6). This
   is 0 while the flank is held, and the whole gap if the film carries no load. */
static double film_ahead(const dynamics_radau *radau, const dynamics_step *f, double x,
                         double delta)
{
    if (f->pressed && f->side > 0)
        return 0;
    if (f->landing && f->landing->open[0])
        return value_in_oil(radau, f->landing->film[0], x);
    return f->excitation->half_gap - delta;
}

static void add_sample(dynamics_trajectory *t, const dynamics_step *f, double x, double phase)
{
    dynamics_record *record = t->record;
    if (record->count == record->capacity)
        return;
    moment m = moment_at(f, x);
    record->samples[record->count++] = (dynamics_sample){
        .phase = (double)record->cycles + phase,
        .s = m.delta + m.e,
        .s_rate = m.rate + m.e_rate,
        .force = f->landing ? value_in_oil(t->radau, f->landing->force, x)
                            : dynamics_mesh_force(f->excitation, f->piece, phase - f->piece->start,
                                                  m.delta, m.rate),
        .film = film_ahead(t->radau, f, x, m.delta),
    };
}

static int jumps_at_end(const dynamics_step *f)
{
    const dynamics_track track = dynamics_track_with(f->excitation, f->piece);
    const dynamics_piece *next = f->piece, *end = track.pieces + track.count;
    while (next < end && next->start < f->end) /* in free flight a step may pass several nodes */
        next++;
    return next < end ? next->jump && next->start == f->end : track.pieces->jump && f->end == 1;
}

/* At a jump of the excitation, takes two samples at the same phase, one before and one after the
   jump. */
static void take_samples(dynamics_trajectory *t, const dynamics_step *f)
{
    dynamics_record *record = t->record;
    double n = (double)record->per_cycle;
    int starts_piece = f->at == f->piece->start && f->end > f->at;
    if (starts_piece && (f->piece->jump || (f->at == 0 && record->cycles == 0)))
        add_sample(t, f, 0, f->at);
    double last = f->at;
    for (; (double)t->next / n <= f->end; t->next++) {
        double phase = (double)t->next / n;
        if (phase <= f->at)
            continue;
        add_sample(t, f, f->x * (phase - f->at) / (f->end - f->at), phase);
        last = phase;
    }
    if (jumps_at_end(f) && last < f->end)
        add_sample(t, f, f->x, f->end);
}

static void observe_all(void *self, const dynamics_step *f)
{
    dynamics_trajectory *t = self;
    double time = f->x * f->series->h;
    join_strides(t, f);
    add_powers(t, f);
    t->clocks.parted += f->pressed ? 0 : time;
    t->clocks.back += f->pressed && f->side < 0 ? time : 0;
    t->clocks.damped += f->damper > 0 || f->excitation->zeta == 0 ? time : 0;
    take_samples(t, f);
}

static dynamics_state start_of(const double x[2], const dynamics_motion *motion)
{
    return motion->films ? dynamics_state_in_oil(x[0], x[1], motion->films)
                         : dynamics_state_at(x[0], x[1]);
}

/* Sets the derivatives over the shown cycles, and the error in Abel's identity det M = exp(-2 zeta
   t), where t is the time in which the damper acts. */
static int take_monodromy(const dynamics_flow *flow, const double x[2], dynamics_motion *motion)
{
    dynamics_state y = start_of(x, motion);
    for (size_t i = 0; i < motion->cycles; i++)
        if (!dynamics_flow_variation(flow, motion->T, &y, NULL))
            return 0;
    memcpy(motion->monodromy, y.m, sizeof motion->monodromy);
    dynamics_films_monodromy(&y, motion->in_oil);
    if (motion->excitation->film)
        return 1;
    double expected = exp(-2 * motion->excitation->zeta * motion->clocks.damped);
    motion->det_error = expected > 0 ? fabs(y.det / expected - 1) : 0;
    return 1;
}

ff_status dynamics_trajectory_record(const dynamics_flow *flow, const dynamics_inputs *inputs,
                                     size_t per_cycle, const double x[2], dynamics_motion *motion)
{
    size_t tail = dynamics_mesh_cycles_of_engagement(inputs);
    if (!dynamics_record_init(&motion->record, motion->excitation, per_cycle,
                              motion->cycles + tail))
        return FF_NOMEM;
    dynamics_trajectory trace = {.record = &motion->record, .radau = flow->radau};
    dynamics_observer observer = {observe_all, &trace};
    dynamics_state y = start_of(x, motion);
    for (size_t i = 0; i < motion->cycles + tail; i++) {
        if (motion->period > 0 && i % (size_t)motion->period == 0)
            y = start_of(x, motion);
        trace.next = 1;
        if (!dynamics_flow_motion(flow, motion->T, &y, &observer))
            return FF_NOCONV;
        motion->record.cycles++;
        if (i + 1 != motion->cycles)
            continue;
        dynamics_motion_check_energy(motion, trace.start, trace.energy, trace.work,
                                     trace.loss + trace.drag);
        motion->clocks = trace.clocks;
        motion->loss = trace.loss;
        motion->squeeze = trace.films;
        motion->drag = trace.drag;
        /* the jump at phase 0 is before the start and after the end */
        motion->work = trace.work + trace.start - trace.energy;
        motion->thickness = trace.thickness;
    }
    return take_monodromy(flow, x, motion) ? FF_OK : FF_NOCONV;
}
