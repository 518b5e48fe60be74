/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "time-stepper.h"

#include "asperities.h"
#include "heat.h"
#include "lanes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_HALVINGS = 12, MOST_THINNING_HALVINGS = 6 };

/* A step that leaves less than this share of the least film is cut while it can be. Smooth
   flanks. */
static const double MOST_THINNING = 0.5;
/* So is a step that changes the least film by more than this share as the contact opens or
   closes. */
static const double MOST_CHANGE_AT_CONTACT_LOSS = 0.05;

/* Below this share of the load of the step a film is taken to carry none. */
static const double NO_LOAD = 1e-3;
/* The last step of an interval takes all that is left when it would leave less than 1e-3 of it. */
static const double ALMOST_ALL = 0.999;
/* Steps that Newton's method cannot take without load are followed by one 16th of the interval. */
static const double AFTER_FAILURE = 16;

ff_status ehl_march_create(ehl_march *m, const ehl_history *h, ehl_solver *s, int scheme)
{
    enum { EACH = 6, FILMS = EHL_STATES + 2, OWN = 6 };
    size_t n = s->grid->nodes;
    *m = (ehl_march){.history = h, .solver = s, .scheme = scheme, .mirrored = h->mirrored};
    double *next = m->memory = calloc((EACH * FILMS + OWN) * n, sizeof *next);
    unsigned char *full = m->flags_memory = calloc(2 * FILMS * n, 1);
    if (!next || !full)
        return FF_NOMEM;
    for (size_t k = 0; k < FILMS; k++) {
        ehl_state *state = k < EHL_STATES ? &m->state[k] : k == EHL_STATES ? &m->trial : &m->spare;
        state->film.p = next;
        state->film.v = next + n;
        state->mass = next + 2 * n;
        state->film.content = next + 3 * n;
        state->gap = next + 4 * n;
        state->film.plastic = s->reynolds->hardness > 0 ? next + 5 * n : NULL;
        state->film.full = full;
        state->film.asperity = full + n;
        next += EACH * n;
        full += 2 * n;
    }
    double **own[OWN] = {&m->past,   &m->change, &m->deflection, &m->local, &m->accumulated_error,
                         &m->heights};
    for (size_t k = 0; k < OWN; k++, next += n)
        *own[k] = next;
    return FF_OK;
}

void ehl_march_destroy(ehl_march *m)
{
    free(m->memory);
    free(m->flags_memory);
    m->memory = NULL;
    m->flags_memory = NULL;
}

void ehl_copy_film(ehl_film *to, const ehl_film *from, size_t nodes)
{
    memcpy(to->p, from->p, nodes * sizeof *to->p);
    memcpy(to->v, from->v, nodes * sizeof *to->v);
    memcpy(to->full, from->full, nodes);
    memcpy(to->asperity, from->asperity, nodes);
    memcpy(to->content, from->content, nodes * sizeof *to->content);
    to->yielding = from->yielding;
    if (to->plastic && from->plastic)
        memcpy(to->plastic, from->plastic, nodes * sizeof *to->plastic);
    to->h00 = from->h00;
}

ehl_step ehl_instant_step(const ehl_march *m, const ehl_instant *at)
{
    return (ehl_step){
        .entrainment = at->entrainment,
        .sliding = at->sliding,
        .radius = at->radius,
        .load = at->load,
        .loaded = !ehl_contact_is_lost(m, at),
    };
}

double ehl_thinnest(ehl_march *m, double radius, const ehl_film *film)
{
    ehl_reynolds *r = m->solver->reynolds;
    ehl_reynolds_gap(r, radius, film);
    double least = ehl_least(r->nodes, r->h);
    return r->rough ? fmax(least, r->contact) : least;
}

double ehl_march_passage(const ehl_march *m, double speed)
{
    double length = 2 * m->solver->grid->half_width;
    double all = m->history->time[m->history->count - 1] - m->history->time[0];
    return speed * all > length ? length / speed : all;
}

int ehl_march_is_loaded(const ehl_march *m)
{
    return m->step.loaded && m->step.load >= EHL_LIGHT_LOAD * m->history->load_max;
}

void ehl_march_breakpoint(ehl_march *m)
{
    m->smooth = 1;
}

void ehl_march_update_mass(ehl_march *m)
{
    ehl_reynolds *r = m->solver->reynolds;
    m->trial.thinnest = ehl_thinnest(m, m->trial_step.radius, &m->trial.film);
    m->trial.highest = ehl_greatest(r->nodes, m->trial.film.p, 0);
    ehl_reynolds_mass(r, &m->trial.film);
    memcpy(m->trial.mass, r->mass, r->nodes * sizeof *r->mass);
    memcpy(m->trial.gap, r->h, r->nodes * sizeof *r->h);
    if (m->rough)
        ehl_contact_mass(r, &m->trial_step, &m->trial.film, m->trial.mass);
}

void ehl_march_accept(ehl_march *m)
{
    double dt = m->trial_at.time - m->state[0].time;
    m->trial.time = m->trial_at.time;
    m->trial.moved = m->moved;
    m->trial.loaded = m->trial_step.loaded;
    if (m->known > 0) {
        double length = 2 * m->solver->grid->half_width, before = m->distance;
        m->distance += m->trial_step.entrainment * dt;
        if (before < length && m->distance >= length)
            m->renewed = m->trial_at.time;
        double worst = ehl_march_truncation(m);
        ehl_advect_error(m, m->trial_step.entrainment * dt);
        if (worst > m->worst_truncation) {
            m->worst_truncation = worst;
            m->worst_truncation_at = m->trial_at.time;
        }
    }
    if (m->known > 0 && m->trial_step.loaded != m->state[0].loaded)
        m->smooth = 0;
    ehl_state oldest = m->state[EHL_STATES - 1];
    memmove(m->state + 1, m->state, (EHL_STATES - 1) * sizeof m->state[0]);
    m->state[0] = m->trial;
    m->trial = oldest;
    m->known += m->known < EHL_STATES;
    m->smooth += m->smooth < EHL_STATES;
    m->contact_lost = ehl_contact_is_lost(m, &m->trial_at);
    m->step = m->trial_step;
    m->at = m->trial_at;
}

void ehl_march_factors(const ehl_march *m, double time, double c[3])
{
    double dt = time - m->state[0].time;
    c[0] = 1 / dt;
    c[1] = -1 / dt;
    c[2] = 0;
    if (m->scheme == EHL_EULER || m->smooth < 2)
        return;
    double ratio = dt / (m->state[0].time - m->state[1].time);
    c[0] = (1 + 2 * ratio) / ((1 + ratio) * dt);
    c[1] = -(1 + ratio) / dt;
    c[2] = ratio * ratio / ((1 + ratio) * dt);
}

/*
 * d(rho h)/dt = rate rho h + past, by backward Euler or by the two-step backward differentiation
 * formula for unequal steps (Hairer, Norsett & Wanner 1993, III.5). With rough flanks it is taken
 * along the path of the oil, and then contains the wedge.
 */
static void time_derivative(ehl_march *m, ehl_step *step, const ehl_instant *at)
{
    size_t n = m->solver->grid->nodes;
    const double *one = m->state[0].mass, *two = m->state[1].mass;
    double c[3], dt = at->time - m->state[0].time;
    ehl_march_factors(m, at->time, c);
    step->rate = c[0];
    step->past = m->past;
    step->follows = m->rough != NULL;
    if (m->rough)
        ehl_advect_mass(m, &one, &two);
    if (m->scheme == EHL_EULER || m->smooth < 2) {
        for (size_t i = 0; i < n; i++)
            m->past[i] = -one[i] / dt;
        return;
    }
    for (size_t i = 0; i < n; i++)
        m->past[i] = c[1] * one[i] + c[2] * two[i];
}

void ehl_lagrange_factors(const ehl_march *m, double time, size_t count, double *c)
{
    for (size_t k = 0; k < 3; k++) {
        c[k] = k < count;
        for (size_t j = 0; j < count && k < count; j++)
            if (j != k)
                c[k] *= (time - m->state[j].time) / (m->state[k].time - m->state[j].time);
    }
}

size_t ehl_run_of_states(const ehl_march *m, int loaded, size_t most)
{
    size_t count = 0;
    while (count < most && count < m->smooth && m->state[count].loaded == loaded)
        count++;
    return count;
}

/*
 * Sets the trial to a line or parabola in time through the last films; returns 0 while there are
 * too few. Its deflection is computed anew from its pressure: extrapolated by the same factors it
 * would depart from it, as the rounding errors of such a recursion grow with the square of the time
 * over the first step.
 */
static int extrapolate_films(ehl_march *m, double time, int loaded)
{
    const ehl_state *s = m->state;
    size_t n = m->solver->grid->nodes, count = ehl_run_of_states(m, loaded, 3);
    if (count < 2 || (count < 3 && m->known == m->smooth))
        return 0;
    double c[3];
    ehl_lagrange_factors(m, time, count, c);
    ehl_film *film = &m->trial.film;
    const ehl_film *f0 = &s[0].film, *f1 = &s[1].film, *f2 = &s[2].film;
    memcpy(film->full, f0->full, n);
    memcpy(film->asperity, f0->asperity, n);
    for (size_t i = 0; i < n; i++) {
        double p = c[0] * f0->p[i] + c[1] * f1->p[i] + c[2] * f2->p[i];
        film->p[i] = film->full[i] && p > 0 ? p : 0;
    }
    for (size_t i = 0; i < n && m->solver->reynolds->conserving; i++)
        film->content[i] = fmax(0, c[0] * s[0].mass[i] + c[1] * s[1].mass[i] + c[2] * s[2].mass[i]);
    film->h00 = c[0] * f0->h00 + c[1] * f1->h00 + c[2] * f2->h00;
    m->solver->deflect(m->solver, film->p, film->v);
    return 1;
}

/* Sets the trial to the last film: without pressure when the contact opens, and with a first guess
   of the pressure when it closes again. */
static void repeat_last_film(ehl_march *m, const ehl_step *step, const ehl_instant *at)
{
    const ehl_grid *g = m->solver->grid;
    ehl_film *film = &m->trial.film;
    ehl_copy_film(film, &m->state[0].film, g->nodes);
    if (!step->loaded && m->state[0].loaded)
        ehl_remove_pressure(film, m->state[0].mass, g->nodes);
    else if (step->loaded && ehl_film_load(film, g->nodes, g->dx) < NO_LOAD * step->load)
        ehl_first_guess(m->solver, at, m->history->modulus, ehl_thinnest(m, at->radius, film),
                        film);
}

/*
 * Moves the flanks of the last film on at the speed that they had. Where the slope of the load
 * breaks, this speed goes on, since load and film do; flanks that part drive the end of the film
 * back by it. From flanks at rest that end is sought among nodes which only the wedge would fill,
 * and with the pressures cut off there goes the balance of the load.
 */
static int move_on_last_film(ehl_march *m, const ehl_step *step, const ehl_instant *at)
{
    const ehl_state *s = m->state;
    if (m->known < 2 || !step->loaded || !s[0].loaded || !s[1].loaded)
        return 0;
    repeat_last_film(m, step, at);
    m->trial.film.h00 +=
        (at->time - s[0].time) * (s[0].film.h00 - s[1].film.h00) / (s[0].time - s[1].time);
    return 1;
}

static ff_status solve_with_positive_gap(ehl_march *m, const ehl_step *step, const ehl_instant *at,
                                         int limit)
{
    ff_status status = ehl_heat_solve(m, step, &m->trial.film, at->time, limit);
    if (ehl_laws_failed(&m->solver->reynolds->laws))
        return FF_BUG; /* no shorter step will do */
    if (status == FF_OK && !(ehl_thinnest(m, at->radius, &m->trial.film) > 0))
        status = FF_NOCONV;
    return status;
}

/* Continuation in the load, for a sudden load on a film that has no time to give way: goes from the
   load of the last film to that of the step by ratios, which shrink where a solution fails. */
static ff_status continue_in_load(ehl_march *m, const ehl_step *step, const ehl_instant *at)
{
    enum { MOST_LOADS = 60 };
    const ehl_grid *g = m->solver->grid;
    ehl_step load_step = *step;
    ehl_film *film = &m->trial.film, *kept = &m->spare.film;
    ehl_copy_film(film, &m->state[0].film, g->nodes);
    double reached = ehl_film_load(film, g->nodes, g->dx);
    if (!(reached > 0))
        return FF_NOCONV;
    double ratio = step->load / reached > 1 ? 2 : 0.5;
    ehl_copy_film(kept, film, g->nodes);
    for (int k = 0; k < MOST_LOADS && fabs(ratio - 1) > 1e-3; k++) {
        int last = ratio > 1 ? reached * ratio >= step->load : reached * ratio <= step->load;
        load_step.load = last ? step->load : reached * ratio;
        ff_status status = solve_with_positive_gap(m, &load_step, at, EHL_LIMIT_PLAIN);
        if (status < 0 || (status == FF_OK && last))
            return status;
        if (status == FF_OK) {
            reached = load_step.load;
            ehl_copy_film(kept, film, g->nodes);
        } else {
            ehl_copy_film(film, kept, g->nodes);
            do /* the same from the same film would fail again */
                ratio = sqrt(ratio);
            while (last && fabs(ratio - 1) > 1e-3 &&
                   (ratio > 1 ? reached * ratio >= step->load : reached * ratio <= step->load));
        }
    }
    return FF_NOCONV;
}

ff_status ehl_solve_trial(ehl_march *m, ehl_step *step, const ehl_instant *at)
{
    ff_status status = FF_NOCONV;
    ehl_film *film = &m->trial.film;
    time_derivative(m, step, at);
    int carried = m->rough && step->loaded == m->state[0].loaded;
    for (int plain = 0; plain < 2 && status == FF_NOCONV && !(carried && plain); plain++) {
        if (carried)
            ehl_advect_film(m, at);
        else if (plain)
            repeat_last_film(m, step, at);
        else if (!extrapolate_films(m, at->time, step->loaded))
            continue;
        if (!step->loaded)
            film->h00 = at->gap;
        int limit = carried ? EHL_LIMIT_REPEATED : EHL_LIMIT_GUESSED;
        if (carried && m->thermal) /* heat makes mobilities of neighbours differ by decades */
            limit = EHL_LIMIT_START;
        status = solve_with_positive_gap(m, step, at, plain ? EHL_LIMIT_PLAIN : limit);
    }
    if (status == FF_NOCONV && !m->rough && move_on_last_film(m, step, at))
        status = solve_with_positive_gap(m, step, at, EHL_LIMIT_PLAIN);
    if (status == FF_NOCONV && step->loaded && !m->rough)
        status = continue_in_load(m, step, at);
    return status;
}

int ehl_march_step_too_large(const ehl_march *m)
{
    double kept = m->trial.thinnest / m->state[0].thinnest;
    int changed = m->trial_step.loaded != m->state[0].loaded;
    return (!m->rough && kept < MOST_THINNING) ||
           (changed && fabs(kept - 1) > MOST_CHANGE_AT_CONTACT_LOSS);
}

static void reverse_values(double *y, size_t n)
{
    for (size_t i = 0; i < n / 2; i++) {
        double kept = y[i];
        y[i] = y[n - 1 - i];
        y[n - 1 - i] = kept;
    }
}

static void reverse_flags(unsigned char *y, size_t n)
{
    for (size_t i = 0; i < n / 2; i++) {
        unsigned char kept = y[i];
        y[i] = y[n - 1 - i];
        y[n - 1 - i] = kept;
    }
}

/* The equations assume that the oil runs along the nodes. Where the entrainment changes its sign
   the states are mirrored; the domain is as long on both sides. */
static void mirror_states(ehl_march *m, const ehl_instant *at)
{
    size_t n = m->solver->grid->nodes;
    if (!(at->entrainment > 0) || at->mirrored == m->mirrored)
        return;
    for (size_t k = 0; k < m->known; k++) {
        ehl_state *s = &m->state[k];
        double *values[] = {s->film.p, s->film.v, s->film.content, s->mass, s->gap};
        for (size_t j = 0; j < sizeof values / sizeof values[0]; j++)
            reverse_values(values[j], n);
        reverse_flags(s->film.full, n);
        reverse_flags(s->film.asperity, n);
    }
    reverse_values(m->accumulated_error, n);
    m->mirrored = at->mirrored;
}

void ehl_march_place(ehl_march *m, const ehl_instant *at)
{
    ehl_reynolds *r = m->solver->reynolds;
    r->rough = m->rough ? m->heights : NULL;
    mirror_states(m, at);
    if (!m->rough)
        return;
    ehl_grid g = *m->solver->grid;
    double cells = ehl_roughness_travel(m->rough, at->time) / g.dx;
    m->moved = floor(cells);
    g.first += (cells - m->moved) * g.dx;
    ehl_reynolds_place(r, g.first);
    ehl_roughness_heights(m->rough, &g, at->time, m->heights);
}

ff_status ehl_march_try(ehl_march *m, const ehl_instant *at)
{
    ehl_march_place(m, at);
    ehl_step step = ehl_instant_step(m, at);
    ff_status status =
        step.loaded ? ehl_solve_trial(m, &step, at) : ehl_solve_contact_loss(m, &step, at);
    if (status != FF_OK)
        return status;
    m->trial_step = step;
    m->trial_at = *at;
    ehl_march_update_mass(m);
    ehl_estimate_truncation(m);
    return FF_OK;
}

/* Keeps last_good_step: a length that failed is not tried again before STREAK shorter steps
   passed. */
static void limit_step_length(ehl_march *m, ff_status status, double dt)
{
    enum { STREAK = 4 };
    m->good_steps = status == FF_OK ? m->good_steps + 1 : 0;
    if (status != FF_OK)
        m->last_good_step = dt / 2;
    else if (!(m->last_good_step > 0) || m->good_steps >= STREAK) {
        m->last_good_step = 2 * fmax(dt, m->last_good_step / 2);
        m->good_steps = 0;
    }
}

/* Returns the longest step towards `time`, s. With rough flanks the steps are equal, and the oil
   moves by no more cells in one than ehl_largest_advection. */
static double longest_step(const ehl_march *m, double time)
{
    double now = m->state[0].time, steps = 1;
    if (m->rough)
        steps = (ehl_roughness_travel(m->rough, time) - ehl_roughness_travel(m->rough, now)) /
                (m->solver->grid->dx * ehl_largest_advection(m));
    return (time - now) / fmax(1, ceil(steps - 1e-3));
}

ff_status ehl_march_to(ehl_march *m, double time)
{
    double span = longest_step(m, time), dt = span;
    int cut = 0;
    if (m->rough && m->last_good_step > 0)
        dt = fmin(m->last_good_step, span);
    while (m->state[0].time < time) {
        double now = m->state[0].time;
        double target = dt > ALMOST_ALL * (time - now) ? time : now + dt;
        ehl_instant at = ehl_history_at(m->history, target);
        ff_status status = ehl_march_try(m, &at);
        int too_large = status == FF_OK && ehl_march_step_too_large(m) &&
                        target - now > span / (1 << MOST_THINNING_HALVINGS);
        cut |= too_large || status == FF_NOCONV;
        if (m->rough)
            limit_step_length(m, status, target - now);
        if (status == FF_OK && !too_large) {
            ehl_march_accept(m);
            span = m->rough && target < time ? longest_step(m, time) : span;
            dt = fmin(m->rough ? m->last_good_step : 2 * dt, span);
        } else if (too_large || (status == FF_NOCONV && dt > span / (1 << MOST_HALVINGS))) {
            dt = (target - now) / 2;
        } else if (status == FF_NOCONV) {
            status = ehl_march_without_load(m, &at);
            dt = span / AFTER_FAILURE;
        }
        if (status != FF_OK && (status != FF_NOCONV || m->why[0]))
            return status;
    }
    m->steps_cut += cut || dt < span;
    return FF_OK;
}
