/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moves pressure, state and mass of a rough film with the oil. */
#include "advection.h"

#include <math.h>
#include <string.h>

/* Smallest distance that the oil moves in a step, in cells. The cells are too coarse for shorter
   steps to improve the result. */
static const double SHORTEST_ADVECTION = 0.25;

/* If the asperities carry less than this share of the load, the error of their load is compared
   with this share. */
static const double LITTLE = 0.01;

/* Returns the node `cells` cells upstream of node i, from which the oil at node i comes. For oil
   from outside the domain, returns the first node. */
static size_t upstream_node(size_t i, size_t cells)
{
    return i > cells ? i - cells : 0;
}

static size_t cells_since(const ehl_march *m, const ehl_state *s)
{
    return (size_t)fmax(0, m->moved - s->moved);
}

size_t ehl_upstream_node(const ehl_march *m, const ehl_state *s, size_t i)
{
    return upstream_node(i, cells_since(m, s));
}

void ehl_advect_values(const ehl_march *m, const ehl_state *s, size_t each, const double *from,
                       double *to)
{
    size_t cells = cells_since(m, s);
    for (size_t i = 0; i < m->solver->grid->nodes; i++)
        memcpy(to + i * each, from + upstream_node(i, cells) * each, each * sizeof *to);
}

/* Moves the masses of the last two films with the oil. The nodes move with the oil, and are shifted
   back by one cell whenever they have moved by one cell. A film that is only transported therefore
   stays unchanged in any number of steps, and the change of mass along the path of the oil replaces
   the wedge. */
void ehl_advect_mass(ehl_march *m, const double **one, const double **two)
{
    double *moved[2] = {m->change, m->deflection};
    for (size_t k = 0; k < 2 && k < m->smooth; k++)
        ehl_advect_values(m, &m->state[k], 1, m->state[k].mass, moved[k]);
    *one = m->change;
    *two = m->deflection;
}

/* Sets the trial film from the last film, shifted with the nodes. The pressure of the roughness
   moves at about the mean speed. Pressure and thickness are extrapolated from the last step. h00 is
   chosen so that the pressure-weighted mean of the extrapolated thickness is kept. */
void ehl_advect_film(ehl_march *m, const ehl_instant *at)
{
    ehl_reynolds *r = m->solver->reynolds;
    const ehl_state *s = &m->state[0];
    ehl_film *film = &m->trial.film;
    const ehl_state *older = &m->state[1];
    size_t n = m->solver->grid->nodes, cells = cells_since(m, s), more = cells;
    double off = 0, weight = 0, ratio = 0;
    if (m->smooth > 1 && older->loaded == s->loaded) {
        more = cells_since(m, older);
        ratio = fmin(1, (at->time - s->time) / (s->time - older->time));
    }
    for (size_t i = n; i-- > 0;) {
        size_t from = upstream_node(i, cells);
        int inner = i > 0 && i + 1 < n;
        film->full[i] = inner && (s->film.full[from] || from == 0);
        film->asperity[i] = inner && s->film.asperity[from];
        double p = s->film.p[from], gain = ratio * (p - older->film.p[upstream_node(i, more)]);
        film->p[i] = film->full[i] ? fmax(0.5 * p, p + gain) : 0;
        if (film->plastic) {
            film->p[i] = fmin(film->p[i], r->hardness);
            film->plastic[i] = film->p[i] >= r->hardness ? s->film.plastic[from] : 0;
        }
        film->content[i] = s->mass[from];
    }
    film->h00 = s->film.h00;
    m->solver->deflect(m->solver, film->p, film->v);
    ehl_reynolds_gap(r, at->radius, film);
    for (size_t i = 0; i < n; i++) {
        double gap = s->gap[upstream_node(i, cells)];
        gap += ratio * (gap - older->gap[upstream_node(i, more)]);
        off += film->p[i] * (gap - r->h[i]);
        weight += film->p[i];
    }
    if (weight > 0 && at->load > 0)
        film->h00 += off / weight;
}

/* Returns the share of the load that asperities carry in the newest film. */
static double asperity_share(const ehl_march *m)
{
    const ehl_film *film = &m->state[0].film;
    double sum = 0;
    for (size_t i = 0; i < m->solver->grid->nodes; i++)
        sum += film->asperity[i] ? film->p[i] : 0;
    return m->step.load > 0 ? sum * m->solver->grid->dx / m->step.load : 0;
}

/* Returns the largest distance that the oil may move in a step, in cells. Steps of half the inlet
   of an asperity lose 1.3 % of the asperities' load, and the loss is proportional to the square of
   the distance (docs/validation/mixed.md). If asperities carry less than LITTLE of the load, the
   absolute loss may be as large as at LITTLE. */
double ehl_largest_advection(const ehl_march *m)
{
    const double dx = m->solver->grid->dx, contact = m->solver->reynolds->contact;
    double wave = fmax(1, m->rough->cutoff / (EHL_CELLS_PER_WAVE * dx));
    if (!(m->state[0].thinnest < EHL_NEAR_CONTACT * contact))
        return wave;
    double way = ehl_roughness_inlet(m->rough, contact) / (2 * dx);
    way *= sqrt(fmax(1, LITTLE / fmax(asperity_share(m), 1e-300)));
    return fmin(fmax(way, SHORTEST_ADVECTION), wave);
}
