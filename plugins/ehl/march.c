/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "march.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    LIMIT_GUESSED = 12,
    LIMIT_PLAIN = 25,
    LIMIT_START = 60,
    HALVINGS = 12,
    SETTLING = 400,
    REFRESH = 64
};

/* Below this share of the largest load the contact counts as lost. */
static const double lost = 1e-6;

ff_status ff_march_create(ff_march *m, const ff_history *h, ff_solver *s, int scheme)
{
    enum { EACH = 3 };
    size_t n = s->grid->nodes;
    *m = (ff_march){.history = h, .solver = s, .scheme = scheme};
    double *next = m->memory = calloc((EACH * (FF_STATES + 1) + 3) * n, sizeof *next);
    unsigned char *wet = m->wet_memory = calloc((FF_STATES + 1) * n, 1);
    if (!next || !wet)
        return FF_NOMEM;
    for (size_t k = 0; k <= FF_STATES; k++) {
        ff_state *state = k < FF_STATES ? &m->state[k] : &m->trial;
        state->film.p = next;
        state->film.v = next + n;
        state->mass = next + 2 * n;
        state->film.wet = wet;
        next += EACH * n;
        wet += n;
    }
    m->past = next;
    m->change = next + n;
    m->deflection = next + 2 * n;
    return FF_OK;
}

void ff_march_destroy(ff_march *m)
{
    free(m->memory);
    free(m->wet_memory);
    m->memory = NULL;
    m->wet_memory = NULL;
}

static void copy_film(ff_film *to, const ff_film *from, size_t nodes)
{
    memcpy(to->p, from->p, nodes * sizeof *to->p);
    memcpy(to->v, from->v, nodes * sizeof *to->v);
    memcpy(to->wet, from->wet, nodes);
    to->h00 = from->h00;
}

/*
 * Deflections are carried along with the pressures by the same linear steps. Rounding errors grow
 * slowly in that, with the square of the steps, as long as all states of a parabola share them.
 */
static void refresh(ff_march *m)
{
    for (size_t k = 0; k < m->known; k++)
        m->solver->deflect(m->solver, m->state[k].film.p, m->state[k].film.v);
}

/* The trial becomes the newest state. */
static void accept(ff_march *m, const ff_step *step, const ff_instant *at)
{
    ff_reynolds *r = m->solver->reynolds;
    ff_reynolds_gap(r, step->radius, &m->trial.film);
    ff_reynolds_mass(r, &m->trial.film);
    memcpy(m->trial.mass, r->mass, r->nodes * sizeof *r->mass);
    m->trial.time = at->time;
    m->trial.gap = at->gap;
    m->trial.loaded = step->loaded;
    ff_state oldest = m->state[FF_STATES - 1];
    memmove(m->state + 1, m->state, (FF_STATES - 1) * sizeof m->state[0]);
    m->state[0] = m->trial;
    m->trial = oldest;
    m->known += m->known < FF_STATES;
    m->step = *step;
    m->at = *at;
    if (++m->accepted % REFRESH == 0)
        refresh(m);
}

static ff_step instant_step(const ff_march *m, const ff_instant *at)
{
    return (ff_step){
        .entrainment = at->entrainment,
        .sliding = at->sliding,
        .radius = at->radius,
        .load = at->load,
        .loaded = at->load > lost * m->history->load_max,
    };
}

/*
 * d(rho h)/dt = rate rho h + past, by backward Euler or by the two-step backward differentiation
 * formula for unequal steps (Hairer, Norsett & Wanner 1993, III.5).
 */
static void time_derivative(ff_march *m, ff_step *step, double time)
{
    size_t n = m->solver->grid->nodes;
    const double *one = m->state[0].mass, *two = m->state[1].mass;
    double dt = time - m->state[0].time;
    step->past = m->past;
    if (m->scheme == FF_EULER || m->known < 2) {
        step->rate = 1 / dt;
        for (size_t i = 0; i < n; i++)
            m->past[i] = -one[i] / dt;
        return;
    }
    double ratio = dt / (m->state[0].time - m->state[1].time);
    double c1 = -(1 + ratio) / dt, c2 = ratio * ratio / ((1 + ratio) * dt);
    step->rate = (1 + 2 * ratio) / ((1 + ratio) * dt);
    for (size_t i = 0; i < n; i++)
        m->past[i] = c1 * one[i] + c2 * two[i];
}

/* Trial = parabola in time through the last three films; 0: there are none yet. */
static int extrapolate(ff_march *m, double time, int loaded)
{
    const ff_state *s = m->state;
    size_t n = m->solver->grid->nodes;
    if (m->known < 3 || s[0].loaded != loaded || s[1].loaded != loaded || s[2].loaded != loaded)
        return 0;
    double t0 = s[0].time, t1 = s[1].time, t2 = s[2].time;
    double c0 = (time - t1) * (time - t2) / ((t0 - t1) * (t0 - t2));
    double c1 = (time - t0) * (time - t2) / ((t1 - t0) * (t1 - t2));
    double c2 = (time - t0) * (time - t1) / ((t2 - t0) * (t2 - t1));
    ff_film *film = &m->trial.film;
    const ff_film *f0 = &s[0].film, *f1 = &s[1].film, *f2 = &s[2].film;
    double *change = m->change;
    int clipped = 0;
    memcpy(film->wet, f0->wet, n);
    for (size_t i = 0; i < n; i++) {
        double p = c0 * f0->p[i] + c1 * f1->p[i] + c2 * f2->p[i];
        double kept = film->wet[i] && p > 0 ? p : 0;
        change[i] = kept - p;
        clipped |= kept < p || kept > p;
        film->p[i] = kept;
        film->v[i] = c0 * f0->v[i] + c1 * f1->v[i] + c2 * f2->v[i];
    }
    film->h00 = c0 * f0->h00 + c1 * f1->h00 + c2 * f2->h00;
    if (clipped) {
        m->solver->deflect(m->solver, change, m->deflection);
        for (size_t i = 0; i < n; i++)
            film->v[i] += m->deflection[i];
    }
    return 1;
}

static double thinnest(ff_march *m, double radius, const ff_film *film)
{
    ff_reynolds *r = m->solver->reynolds;
    ff_reynolds_gap(r, radius, film);
    double least = r->h[0];
    for (size_t i = 1; i < r->nodes; i++)
        least = fmin(least, r->h[i]);
    return least;
}

/* Takes the pressure off. */
static void strip(ff_film *film, size_t nodes)
{
    memset(film->p, 0, nodes * sizeof *film->p);
    memset(film->v, 0, nodes * sizeof *film->v);
    memset(film->wet, 0, nodes);
}

/* Trial = the last film; when the contact opens, without pressure, and when it closes again, with a
   pressure for the load to begin. */
static void repeat(ff_march *m, const ff_step *step, const ff_instant *at)
{
    const ff_grid *g = m->solver->grid;
    ff_film *film = &m->trial.film;
    copy_film(film, &m->state[0].film, g->nodes);
    if (!step->loaded && m->state[0].loaded)
        strip(film, g->nodes);
    else if (step->loaded && ff_film_load(film, g->nodes, g->dx) < 1e-3 * step->load)
        ff_first_guess(m->solver, at, m->history->modulus, thinnest(m, at->radius, film), film);
}

/*
 * h00 of an instant without load. The flanks part by as much as the gap grows; as the contact
 * opens, the elastic deflection is released, and the flanks stand as far apart as the film that
 * they had.
 */
static double approach(ff_march *m, const ff_instant *at)
{
    const ff_state *s = &m->state[0];
    if (s->loaded)
        return thinnest(m, m->at.radius, &s->film) + at->gap;
    return s->film.h00 + at->gap - s->gap;
}

/*
 * What is left where the unloaded film cannot be solved, as in a hasty approach: the prescribed gap
 * without pressure, which is also what no load asks for.
 */
static void carry_bare(ff_march *m, double time)
{
    ff_instant at = ff_history_at(m->history, time);
    ff_step step = instant_step(m, &at);
    time_derivative(m, &step, time);
    repeat(m, &step, &at);
    m->trial.film.h00 = approach(m, &at);
    strip(&m->trial.film, m->solver->grid->nodes);
    accept(m, &step, &at);
    m->bare_steps++;
}

/* One implicit step to `time`. */
static ff_status attempt(ff_march *m, double time)
{
    ff_instant at = ff_history_at(m->history, time);
    ff_step step = instant_step(m, &at);
    ff_status status = FF_NOCONV;
    time_derivative(m, &step, time);
    for (int plain = 0; plain < 2 && status == FF_NOCONV; plain++) {
        if (plain)
            repeat(m, &step, &at);
        else if (!extrapolate(m, time, step.loaded))
            continue;
        if (!step.loaded)
            m->trial.film.h00 = approach(m, &at);
        status =
            m->solver->solve(m->solver, &step, &m->trial.film, plain ? LIMIT_PLAIN : LIMIT_GUESSED);
        if (status == FF_OK && !(thinnest(m, at.radius, &m->trial.film) > 0))
            status = FF_NOCONV;
    }
    if (status == FF_OK)
        accept(m, &step, &at);
    return status;
}

static int is_loaded(const ff_march *m, double time)
{
    ff_instant at = ff_history_at(m->history, time);
    return instant_step(m, &at).loaded;
}

/* Not even a short step to `near` converges: the end of the run, or, without load, a bare step,
   if possible to `far`. */
static ff_status give_up(ff_march *m, double near, double far)
{
    if (!is_loaded(m, near)) {
        carry_bare(m, is_loaded(m, far) ? near : far);
        return FF_OK;
    }
    snprintf(m->why, sizeof m->why,
             "Newton's method did not converge in a time step that was halved %d times", HALVINGS);
    return FF_NOCONV;
}

ff_status ff_march_to(ff_march *m, double time)
{
    double span = time - m->state[0].time, dt = span, bare = span / 16;
    int cut = 0;
    while (m->state[0].time < time) {
        double now = m->state[0].time;
        double target = dt > 0.999 * (time - now) ? time : now + dt;
        ff_status status = attempt(m, target);
        cut |= status == FF_NOCONV;
        if (status == FF_OK) {
            dt = fmin(2 * dt, span);
        } else if (status == FF_NOCONV && dt > span / (1 << HALVINGS)) {
            dt = (target - now) / 2;
        } else if (status == FF_NOCONV) {
            status = give_up(m, target, fmin(time, now + bare));
            dt = bare;
        }
        if (status != FF_OK && (status != FF_NOCONV || m->why[0]))
            return status;
    }
    m->steps_cut += cut;
    return FF_OK;
}

/* From the guess to the steady film by ever longer Euler steps at fixed conditions. */
static ff_status settle(ff_march *m, const ff_step *steady, const ff_instant *at)
{
    ff_reynolds *r = m->solver->reynolds;
    size_t n = r->nodes;
    ff_film *film = &m->trial.film, *kept = &m->state[0].film;
    ff_step step = *steady;
    double dt = r->dx / at->entrainment, end = 1e4 * (double)n * dt;
    ff_first_guess(m->solver, at, m->history->modulus,
                   ff_moes_film(at, m->history->modulus, &r->oil), film);
    copy_film(kept, film, n);
    step.past = m->past;
    for (int k = 0; k < SETTLING && dt < end; k++) {
        ff_reynolds_gap(r, at->radius, kept);
        ff_reynolds_mass(r, kept);
        step.rate = 1 / dt;
        for (size_t i = 0; i < n; i++)
            m->past[i] = -r->mass[i] / dt;
        ff_status status = m->solver->solve(m->solver, &step, film, LIMIT_PLAIN);
        if (status == FF_OK && thinnest(m, at->radius, film) > 0) {
            copy_film(kept, film, n);
            dt *= 2;
        } else {
            copy_film(film, kept, n);
            dt /= 4;
        }
    }
    return dt < end ? FF_NOCONV : m->solver->solve(m->solver, steady, film, LIMIT_START);
}

ff_status ff_march_start(ff_march *m)
{
    const ff_history *h = m->history;
    ff_reynolds *r = m->solver->reynolds;
    ff_instant at = ff_history_at(h, h->time[0]);
    m->start_unloaded = !(at.load > lost * h->load_max);
    if (m->start_unloaded)
        at.load = 0.01 * h->load_max;
    ff_step step = instant_step(m, &at);
    ff_film *film = &m->trial.film;
    ff_first_guess(m->solver, &at, h->modulus, ff_moes_film(&at, h->modulus, &r->oil), film);
    ff_status status = m->solver->solve(m->solver, &step, film, LIMIT_START);
    if (status == FF_OK && !(thinnest(m, at.radius, film) > 0))
        status = FF_NOCONV;
    if (status == FF_NOCONV) {
        m->start_cut = 1;
        status = settle(m, &step, &at);
    }
    if (status == FF_OK && !(thinnest(m, at.radius, film) > 0))
        status = FF_NOCONV;
    if (status == FF_NOCONV)
        snprintf(m->why, sizeof m->why, "the steady film of the first instant was not found");
    if (status == FF_OK)
        accept(m, &step, &at);
    return status;
}
