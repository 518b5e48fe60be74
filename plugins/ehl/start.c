/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds steady films: on one grid, by nested grids, and that which the marching begins with. */
#include "start.h"

#include "deflection.h"
#include "heat.h"
#include "thermal.h"
#include "time-stepper.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/*
 * Half an ellipse of pressure: Hertz's under high load, and as wide as the pressure of a rigid
 * cylinder (from -2 S to 0.475 S, S = sqrt(2 R h)) under low load.
 */
void ehl_first_guess(ehl_solver *s, const ehl_instant *at, double modulus, double thinnest,
                     ehl_film *film)
{
    const ehl_grid *g = s->grid;
    double a = ehl_hertz_half_width(at->load, at->radius, modulus);
    double film_length = sqrt(2 * at->radius * thinnest);
    double width = hypot(a, 1.2 * film_length), sum = 0;
    double centre = -0.5 * film_length * film_length / (a + film_length);
    centre = fmax(centre, -0.5 * g->inlet);
    width = fmin(fmax(width, 2 * g->dx), 0.9 * fmin(g->inlet, g->outlet));
    memset(film->full, 0, g->nodes);
    memset(film->asperity, 0, g->nodes);
    for (size_t i = 0; i < g->nodes; i++) {
        double x = (g->first + (double)i * g->dx - centre) / width;
        int inner = i > 0 && i + 1 < g->nodes;
        film->p[i] = inner && fabs(x) < 1 ? sqrt(1 - x * x) : 0;
        film->full[i] = inner && x < 1;
        sum += film->p[i];
    }
    for (size_t i = 0; i < g->nodes; i++)
        film->p[i] *= at->load / (sum * g->dx);
    s->deflect(s, film->p, film->v);
    film->h00 = 0;
    ehl_reynolds_gap(s->reynolds, at->radius, film);
    double least = s->reynolds->h[0];
    for (size_t i = 0; i < g->nodes; i++)
        least = fmin(least, s->reynolds->h[i]);
    film->h00 = thinnest - least;
    for (size_t i = 0; i < g->nodes; i++)
        film->content[i] = s->reynolds->oil.density * thinnest;
}

/* Accuracy of the films that finer grids go on from, or that errors by the cells are measured
   with. */
static const double loose = 1e-3;

void ehl_grid_level_destroy(ehl_grid_level *l)
{
    if (l->solver.destroy)
        l->solver.destroy(&l->solver);
    ehl_reynolds_destroy(&l->reynolds);
    free(l->memory);
    free(l->flags);
    *l = (ehl_grid_level){0};
}

ff_status ehl_grid_level_create(ehl_grid_level *l, const ehl_solver *s, size_t cells,
                                double modulus)
{
    const ehl_reynolds *r = s->reynolds;
    size_t n = cells + 1;
    *l = (ehl_grid_level){.grid = *s->grid};
    l->grid.nodes = n;
    l->grid.dx = (s->grid->inlet + s->grid->outlet) / (double)cells;
    if (ehl_reynolds_create(&l->reynolds, &l->grid, &r->laws, &r->oil, r->wedge) != FF_OK)
        return FF_NOMEM;
    double *next = l->memory = calloc(4 * n, sizeof *next);
    l->flags = calloc(2 * n, 1);
    if (!next || !l->flags)
        return FF_NOMEM;
    l->film = (ehl_film){.p = next, .v = next + n, .content = next + 2 * n, .full = l->flags};
    l->film.asperity = l->flags + n;
    l->kernel = next + 3 * n;
    ehl_kernel_fill(n, l->grid.dx, modulus, l->grid.half_width, l->kernel);
    l->reynolds.floor = r->floor;
    l->reynolds.conserving = r->conserving;
    l->reynolds.contact = r->contact;
    l->reynolds.leak = r->leak;
    l->reynolds.unit = r->oil.density * (l->kernel[0] - l->kernel[n - 1]);
    l->solver = (ehl_solver){.grid = &l->grid,
                             .reynolds = &l->reynolds,
                             .kernel = l->kernel,
                             .modulus = modulus,
                             .tolerance = fmax(s->tolerance, loose),
                             .outside = s->outside,
                             .maker = s->maker};
    return s->maker(&l->solver);
}

void ehl_grid_level_refine(const ehl_grid_level *before, ehl_solver *s, ehl_film *film)
{
    const ehl_film *from = &before->film;
    const ehl_grid *coarse = &before->grid;
    size_t n = s->grid->nodes;
    for (size_t i = 0; i < n; i++) {
        double place = (double)i * s->grid->dx / coarse->dx;
        size_t k = (size_t)place;
        k = k + 2 < coarse->nodes ? k : coarse->nodes - 2;
        double far = fmin(place - (double)k, 1);
        int inner = i > 0 && i + 1 < n;
        film->p[i] = inner ? (1 - far) * from->p[k] + far * from->p[k + 1] : 0;
        film->content[i] = (1 - far) * from->content[k] + far * from->content[k + 1];
        film->full[i] = inner && (from->full[k] || from->full[k + 1]);
        film->asperity[i] = 0;
    }
    film->h00 = from->h00;
    s->deflect(s, film->p, film->v);
}

ff_status ehl_grid_level_solve(ehl_grid_level *l, const ehl_grid_level *before,
                               const ehl_step *step, const ehl_instant *at, double modulus,
                               double thinnest)
{
    if (before)
        ehl_grid_level_refine(before, &l->solver, &l->film);
    else
        ehl_first_guess(&l->solver, at, modulus, thinnest, &l->film);
    return l->solver.solve(&l->solver, step, &l->film, EHL_LIMIT_START);
}

/* Cells that are not halved any more. */
enum { COARSEST = 512 };

/*
 * Fills `film` with the steady film of half the cells, by nested grids: the end of a film moves by
 * few cells in a step of Newton's method, so that it is found on a coarse grid first, and each
 * finer one begins with what the one before has found. FF_NOCONV: the grid of `s` is coarse itself,
 * or none of the coarser ones has a solution.
 */
static ff_status nested_film(ehl_solver *s, const ehl_step *step, const ehl_instant *at,
                             double modulus, double thinnest, ehl_film *film)
{
    ehl_grid_level l[2] = {0};
    size_t all = s->grid->nodes - 1, halvings = 0, now = 0;
    int found = 0;
    ff_status status = FF_NOCONV;
    while (all >> (halvings + 1) >= COARSEST)
        halvings++;
    for (size_t k = halvings; k > 0; k--) {
        ehl_grid_level *before = &l[now];
        now = 1 - now;
        ehl_grid_level_destroy(&l[now]);
        status = ehl_grid_level_create(&l[now], s, all >> k, modulus);
        if (status == FF_OK)
            status =
                ehl_grid_level_solve(&l[now], found ? before : NULL, step, at, modulus, thinnest);
        if (status != FF_OK && (found || status != FF_NOCONV))
            break;
        found = status == FF_OK; /* what is too coarse for a film is left out */
    }
    if (status == FF_OK)
        ehl_grid_level_refine(&l[now], s, film);
    ehl_grid_level_destroy(&l[0]);
    ehl_grid_level_destroy(&l[1]);
    return status;
}

enum { SETTLING = 400 };

/* Without load at the start the film of this share of the largest load is taken. */
static const double light = 0.01;

/* Approaches the steady film from the guess by ever longer Euler steps at fixed conditions. */
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
    ff_status status = nested_film(s, step, at, modulus, thinnest, film);
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

/* Finds the steady film in the trial. Where there is none with heat from the guess, the film
   without heat is looked for, which tells whether heat is why, and the one with heat from there:
   settling with heat takes the temperatures through decades of viscosity, and where it ends is
   chance. */
static ff_status find_steady(ehl_march *m, const ehl_step *step, const ehl_instant *at)
{
    ff_status status = look_for_steady(m, step, at), cold;
    if (status != FF_NOCONV || !m->thermal)
        return status;
    ehl_thermal_restart(m);
    m->thermal->without = 1;
    cold = look_for_steady(m, step, at);
    m->thermal->without = 0;
    m->thermal->cold_fails = cold == FF_NOCONV;
    return cold == FF_OK ? solve_from_trial(m, step, at) : cold;
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
    else
        status = find_steady(m, &step, &at);
    if (status == FF_NOCONV)
        snprintf(m->why, sizeof m->why, "the steady film of the first instant was not found");
    if (status == FF_OK) {
        m->trial_step = step;
        m->trial_at = at;
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
    m->good_steps = m->contact_lost = 0;
    m->moved = m->last_good_step = 0;
    memset(m->accumulated_error, 0, n * sizeof *m->accumulated_error);
    memset(m->local, 0, n * sizeof *m->local);
}

/*
 * Rough flanks start smooth, at an earlier time, and their roughness enters with the oil: by the
 * first instant it has reached the far side of the widest contact, and goes on from there.
 */
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

/* Solutions on one grid and on the next finer one. */
