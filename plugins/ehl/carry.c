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
 * The film is followed on its way, so that waves and valleys are not smeared: what only moves comes
 * through unchanged. A step of one cell with two-step differences is the second-order upwind wedge
 * where all is steady.
 */
void ff_follow(ff_march *m, const ff_instant *at, const double **one, const double **two)
{
    const ff_grid *g = m->solver->grid;
    double here = ff_rough_travel(m->rough, at->time);
    for (int k = 0; k < 2 && k < (int)m->smooth; k++) {
        double way = here - ff_rough_travel(m->rough, m->state[k].time);
        move_mass(m->state[k].mass, way / g->dx, g->nodes, k ? m->deflection : m->change);
    }
    *one = m->change;
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
