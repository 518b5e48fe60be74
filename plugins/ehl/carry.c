/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rough flanks: what the oil takes along on its way through the contact. */
#include "march-part.h"

#include <math.h>

/* Slope of the mass in a cell, that makes no new extremum (van Leer 1977). */
static double limited_slope(const double *m, size_t i, size_t n)
{
    if (i == 0 || i + 1 >= n)
        return 0;
    double back = m[i] - m[i - 1], front = m[i + 1] - m[i], middle = (back + front) / 2;
    if (!(back * front > 0))
        return 0;
    double most = 2 * fmin(fabs(back), fabs(front));
    return copysign(fmin(most, fabs(middle)), middle);
}

/* moved = what the oil in m has become after `cells`: the mass of each cell is that of the stretch
   it comes from, with m linear in the cells; in front of the domain it is that of the first. */
static void move_mass(const double *m, double cells, size_t n, double *moved)
{
    double reach = fmin(fmax(cells, 0), (double)n);
    size_t whole = (size_t)reach;
    double part = reach - (double)whole; /* of the cell further upstream */
    for (size_t i = 0; i < n; i++) {
        size_t near = i > whole ? i - whole : 0, far = near > 0 ? near - 1 : 0;
        double bend = part * (1 - part) / 2;
        moved[i] = (1 - part) * m[near] + part * m[far] +
                   bend * (limited_slope(m, far, n) - limited_slope(m, near, n));
    }
}

/*
 * Takes out of m what leaves each cell while the oil moves on by `cells`, through faces that follow
 * it: then = m - (passed - passed before), with the share of the face that is not wedge.
 */
static void let_pass(const ff_march *m, const double *mass, double cells, double *then)
{
    const double *wedge = m->solver->reynolds->wedge_share;
    size_t n = m->solver->grid->nodes;
    double passed = cells * mass[0], before = (1 - wedge[0]) * passed;
    move_mass(mass, cells, n, then);
    then[0] = mass[0];
    for (size_t i = 1; i < n; i++) {
        passed += mass[i] - then[i];
        double through = (1 - wedge[i]) * passed;
        then[i] = mass[i] - through + before;
        before = through;
    }
}

/*
 * In the middle of the contact the film is followed on its way, so that the valleys are not smeared
 * and no step is too long for what only moves; where it forms and leaves, the wedge stands for the
 * motion, which has no error when all is steady.
 */
void ff_follow(ff_march *m, const ff_instant *at, const double **one, const double **two)
{
    const ff_grid *g = m->solver->grid;
    double a = ff_hertz_half_width(at->load, at->radius, m->history->modulus);
    double here = ff_rough_travel(m->rough, at->time);
    for (size_t i = 0; i < g->nodes; i++) {
        double x = fabs(g->first + ((double)i + 0.5) * g->dx), share = (x / a - 0.7) / 0.2;
        m->solver->reynolds->wedge_share[i] = a > 0 ? fmin(fmax(share, 0), 1) : 1;
    }
    let_pass(m, m->state[0].mass, (here - ff_rough_travel(m->rough, m->state[0].time)) / g->dx,
             m->change);
    *one = m->change;
    if (m->smooth < 2)
        return;
    let_pass(m, m->state[1].mass, (here - ff_rough_travel(m->rough, m->state[1].time)) / g->dx,
             m->deflection);
    *two = m->deflection;
}

/*
 * Rough flanks: the roughness takes its pressure along, at about the mean speed. Trial = the last
 * film, moved on as far as the oil was carried; its gap keeps the mean thickness under pressure.
 */
void ff_carry_on(ff_march *m, const ff_instant *at)
{
    const ff_grid *g = m->solver->grid;
    ff_reynolds *r = m->solver->reynolds;
    const ff_state *s = &m->state[0];
    ff_film *film = &m->trial.film;
    size_t n = g->nodes;
    double cells = fmin(at->entrainment * (at->time - s->time) / g->dx, (double)n);
    size_t whole = (size_t)cells;
    double part = cells - (double)whole, off = 0, weight = 0;
    for (size_t i = n; i-- > 0;) {
        size_t near = i > whole ? i - whole : 0, far = near > 0 ? near - 1 : 0;
        size_t kind = part < 0.5 ? near : far;
        int inner = i > 0 && i + 1 < n;
        film->wet[i] = inner && (s->film.wet[kind] || kind == 0);
        film->touch[i] = inner && s->film.touch[kind];
        film->p[i] = inner ? (1 - part) * s->film.p[near] + part * s->film.p[far] : 0;
        film->content[i] = (1 - part) * s->mass[near] + part * s->mass[far];
        if (!film->wet[i])
            film->p[i] = 0;
    }
    film->h00 = s->film.h00;
    m->solver->deflect(m->solver, film->p, film->v);
    ff_reynolds_gap(r, at->radius, film);
    for (size_t i = 0; i < n; i++) {
        size_t near = i > whole ? i - whole : 0, far = near > 0 ? near - 1 : 0;
        off += film->p[i] * ((1 - part) * s->gap[near] + part * s->gap[far] - r->h[i]);
        weight += film->p[i];
    }
    if (weight > 0 && at->load > 0)
        film->h00 += off / weight;
}
