/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the steady film from which the march begins. */
#include "start.h"
#include "error-transport.h"

#include "../heat/heat.h"
#include "../heat/thermal.h"
#include "../solvers/grid-level.h"
#include "time-stepper.h"
#include "trial.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SETTLING = 400 };

/* A history that begins without load starts with the film of this share of the largest load. */
static const double light = 0.01;

/* Approaches the steady film from the guess by Euler steps of growing length at fixed conditions.
 */
static ff_status settle(ehl_march *m, const ehl_step *steady, const ehl_instant *at)
{
    ehl_reynolds *r = m->solver->reynolds;
    size_t n = r->nodes;
    ehl_film *film = &m->trial.film, *kept = &m->state[0].film;
    ehl_step step = *steady;
    double dt = r->dx / at->entrainment, end = 1e4 * (double)n * dt;
    ehl_first_guess(m->solver, at, m->history->modulus,
                    ehl_moes_film(at, m->history->modulus, &r->oil), film);
    ehl_copy_film(kept, film, n);
    step.past = m->past;
    for (int k = 0; k < SETTLING && dt < end; k++) {
        ehl_reynolds_gap(r, at->radius, kept);
        ehl_reynolds_mass(r, kept);
        step.rate = 1 / dt;
        for (size_t i = 0; i < n; i++)
            m->past[i] = -r->mass[i] / dt;
        ff_status status = ehl_heat_solve(m, &step, film, at->time, EHL_LIMIT_PLAIN);
        if (status == FF_OK && ehl_thinnest(m, at->radius, film) > 0) {
            ehl_copy_film(kept, film, n);
            dt *= 2;
        } else {
            ehl_copy_film(film, kept, n);
            dt /= 4;
        }
    }
    return dt < end ? FF_NOCONV : FF_OK;
}

/* Solves by Newton's method from the film in the trial. */
static ff_status solve_from_trial(ehl_march *m, const ehl_step *step, const ehl_instant *at)
{
    ehl_film *film = &m->trial.film;
    ff_status status = ehl_heat_solve(m, step, film, at->time, EHL_LIMIT_START);
    if (status == FF_OK && !(ehl_thinnest(m, at->radius, film) > 0))
        status = FF_NOCONV;
    return status;
}

/* Looks for the steady film in the trial: from coarser grids, from a guess, or by settling. */
static ff_status look_for_steady(ehl_march *m, const ehl_step *step, const ehl_instant *at)
{
    ehl_solver *s = m->solver;
    ehl_film *film = &m->trial.film;
    double modulus = m->history->modulus, thinnest = ehl_moes_film(at, modulus, &s->reynolds->oil);
    ff_status status = ehl_nested_film(s, step, at, modulus, thinnest, film);
    if (status == FF_OK)
        status = solve_from_trial(m, step, at);
    if (status == FF_NOCONV) {
        ehl_first_guess(s, at, modulus, thinnest, film);
        status = solve_from_trial(m, step, at);
    }
    if (status == FF_NOCONV && settle(m, step, at) == FF_OK)
        status = solve_from_trial(m, step, at);
    return status;
}

/* Looks for the film with heat, from the one without heat in the trial, with more and more damping
 * across: a hot inlet has no film on few nodes with little damping. node_error shows the error that
 * the damping leaves. */
static ff_status warm_up(ehl_march *m, const ehl_step *step, const ehl_instant *at)
{
    enum { TRIES = 3 };
    const double more = 4, usual = 1;
    size_t n = m->solver->grid->nodes;
    ehl_film *film = &m->trial.film, *cold = &m->state[0].film;
    ff_status status = FF_NOCONV;
    ehl_copy_film(cold, film, n);
    m->thermal->energy.damping = usual;
    for (int k = 0; k < TRIES && status == FF_NOCONV; k++) {
        if (k > 0) {
            m->thermal->energy.damping *= more;
            ehl_copy_film(film, cold, n);
        }
        ehl_thermal_restart(m);
        status = solve_from_trial(m, step, at);
    }
    return status;
}

/* Finds the steady film in the trial. A film with heat is found from the one without; that also
 * shows whether heat is the reason if there is none. */
static ff_status find_steady(ehl_march *m, const ehl_step *step, const ehl_instant *at)
{
    if (!m->thermal)
        return look_for_steady(m, step, at);
    m->thermal->without = 1;
    ff_status status = look_for_steady(m, step, at);
    m->thermal->without = 0;
    m->thermal->cold_fails = status == FF_NOCONV;
    return status == FF_OK ? warm_up(m, step, at) : status;
}

/* Finds the steady film of statistical flanks in the trial, from that of smooth flanks, by
 * continuation in the load that their asperities carry. Their share grows by ratios that shrink if
 * a solution fails and grow if one is found; for nearly dry flanks the last ratios are small. */
static ff_status find_steady_of_asperities(ehl_march *m, const ehl_step *step,
                                           const ehl_instant *at)
{
    enum { MOST_SHARES = 200 };
    const double first = 1e-3, least = 1.0005, grown = 1.3;
    ehl_reynolds *r = m->solver->reynolds;
    ehl_statistical *flanks = &r->statistical;
    const size_t n = r->nodes;
    ehl_film *film = &m->trial.film, *kept = &m->spare.film;
    double reached = 0, ratio = 1 / first;
    flanks->share = 0;
    ff_status status = find_steady(m, step, at);
    flanks->share = 1;
    if (status == FF_OK) {
        ehl_copy_film(kept, film, n);
        ehl_reynolds_gap(r, step->radius, film);
        reached = !r->touching;
    }
    for (int k = 0; k < MOST_SHARES && status == FF_OK && reached < 1; k++) {
        flanks->share = fmin(1, fmax(reached, first) * ratio);
        status = solve_from_trial(m, step, at);
        if (status == FF_OK) {
            reached = flanks->share;
            ratio = pow(ratio, grown);
            ehl_copy_film(kept, film, n);
        } else if (status == FF_NOCONV && ratio > least) {
            ehl_copy_film(film, kept, n);
            ratio = sqrt(ratio);
            status = FF_OK;
        }
    }
    flanks->share = 1;
    return status == FF_OK && reached < 1 ? FF_NOCONV : status;
}

/* Fills the gap with oil without pressure, as it is at rest. */
static void fill_gap(ehl_march *m, const ehl_instant *at)
{
    size_t n = m->solver->grid->nodes;
    ehl_film *film = &m->trial.film;
    film->h00 = at->gap;
    for (size_t i = 0; i < n; i++) {
        film->p[i] = film->v[i] = 0;
        film->full[i] = i > 0 && i + 1 < n;
        film->asperity[i] = 0;
    }
}

ff_status ehl_march_start_at(ehl_march *m, double time)
{
    ehl_instant at = ehl_history_before(m->history, time);
    ff_status status = FF_OK;
    m->start_unloaded = ehl_contact_is_lost(m, &at);
    int still = m->start_unloaded && !(at.entrainment > 0);
    ehl_march_place(m, &at);
    if (m->start_unloaded && !still)
        at.load = light * m->history->load_max;
    ehl_step step = ehl_instant_step(m, &at);
    if (still)
        fill_gap(m, &at);
    else if (m->solver->reynolds->statistical.law)
        status = find_steady_of_asperities(m, &step, &at);
    else
        status = find_steady(m, &step, &at);
    if (status == FF_NOCONV)
        snprintf(m->why, sizeof m->why, "the steady film of the first instant was not found");
    if (status == FF_OK) {
        m->trial_step = step;
        m->trial_at = at;
        m->evaluated = 0;
        ehl_march_update_mass(m);
        ehl_march_accept(m);
        m->contact_lost = m->start_unloaded;
    }
    return status;
}

void ehl_march_restart(ehl_march *m)
{
    size_t n = m->solver->grid->nodes;
    m->known = m->smooth = 0;
    if (m->transport)
        ehl_transport_restart(m->transport);
    m->good_steps = m->contact_lost = 0;
    m->moved = m->last_good_step = 0;
    memset(m->accumulated_error, 0, n * sizeof *m->accumulated_error);
    memset(m->local, 0, n * sizeof *m->local);
}

/* Rough flanks start smooth, at an earlier time, and their roughness enters with the oil. By the
 * first instant it has reached the far side of the widest contact, and it goes on from there. */
ff_status ehl_march_start(ehl_march *m)
{
    double first = m->history->time[0];
    if (!m->rough)
        return ehl_march_start_at(m, first);
    const ehl_grid *g = m->solver->grid;
    ehl_instant at = ehl_history_before(m->history, first);
    double a = g->half_width;
    m->rough->ramp = 0.5 * a;
    m->rough->front = fmin(1.5 * a, g->outlet);
    double way = m->rough->ramp + fmin(2 * a, g->inlet) + m->rough->front;
    ff_status status = ehl_march_start_at(m, first - way / at.entrainment);
    if (status == FF_OK)
        status = ehl_march_to(m, first);
    m->steps_cut = 0;
    return status;
}
