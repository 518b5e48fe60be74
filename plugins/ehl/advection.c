/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What moves on with the oil: pressure, state and mass of a rough film, and truncation errors on
   their way through the contact. */
#include "time-stepper.h"

#include <math.h>
#include <string.h>

/* Shortest way of the oil in a step, in cells: shorter steps gain nothing that the cells
   resolve. */
static const double SHORTEST_ADVECTION = 0.25;

/* Returns the node that the oil at node i comes from, `cells` upstream; oil from outside the domain
   is that of the first node. */
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

/*
 * The nodes move with the oil, and are moved back by a whole cell when they have moved by one. What
 * is only transported thus stays unchanged in any number of steps, and the change of mass along the
 * path of the oil takes the place of the wedge.
 */
void ehl_advect_mass(ehl_march *m, const double **one, const double **two)
{
    double *moved[2] = {m->change, m->deflection};
    for (size_t k = 0; k < 2 && k < m->smooth; k++)
        ehl_advect_values(m, &m->state[k], 1, m->state[k].mass, moved[k]);
    *one = m->change;
    *two = m->deflection;
}

/*
 * The roughness carries its pressure along at about the mean speed. The trial becomes the last film
 * on the nodes as they have moved, with pressure and thickness extrapolated from the last step, h00
 * being such that the mean of the thickness, weighted by the pressure, is what was extrapolated.
 */
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

double ehl_largest_advection(const ehl_march *m)
{
    double contact = m->solver->reynolds->contact;
    double inlet = ehl_roughness_inlet(m->rough, contact) / m->solver->grid->dx;
    return m->state[0].thinnest < EHL_NEAR_CONTACT * contact
               ? fmin(fmax(inlet / 2, SHORTEST_ADVECTION), 1)
               : 1;
}

/*
 * Returns the x from which on errors accumulate: half a pressure build-up length upstream of the
 * contact, since further upstream the pressure flow determines the film anew. Without load the film
 * keeps its errors all over the width of the contact.
 */
static double start_of_accumulation(const ehl_march *m)
{
    double load = m->trial_at.load, radius = m->trial_at.radius, h = m->trial.thinnest;
    if (!m->trial_step.loaded || !(load > 0 && h > 0))
        return -m->solver->grid->half_width;
    double a = ehl_hertz_half_width(load, radius, m->history->modulus);
    return -a - ehl_inlet_buildup(a, radius, h) / 2;
}

/* Updates the distance over which the film still stems from a jump of the load within a step, which
   steps of second order do not resolve. */
static void detect_load_jump(ehl_march *m, double distance)
{
    const double leap = 1.2, passage = 3 * m->solver->grid->half_width;
    double before = m->at.load, now = m->trial_at.load;
    int jumped = !(now < leap * before && before < leap * now);
    m->distance_of_jump = jumped ? passage : fmax(m->distance_of_jump - distance, 0);
}

/*
 * Returns the error of a step at a breakpoint of the film. Where the third difference is as large
 * as the second, a breakpoint leaves half of the second as the error, step after step: y' = 0, then
 * v, with equal steps gives 0, 2/3, 14/9, 68/27 v dt for 0, 1, 2, 3, so that the errors add up to v
 * dt/2, whereas those of the third difference take each other off.
 */
static double error_at_kink(double local, double third, double second)
{
    return fabs(third) > fabs(second) / 2 && fabs(second) > 2 * fabs(local) ? second / 2 : local;
}

/* Moves the accumulated error on with the film by `cells`, and adds the mean of `local` along that
   path downstream of node `first`. */
static void advect_and_add(ehl_march *m, size_t first, double cells)
{
    size_t n = m->solver->grid->nodes, whole = (size_t)fmin(cells, (double)n);
    double part = fmin(cells, (double)n) - (double)whole, met = 0;
    double *accumulated_error = m->accumulated_error, *local = m->local;
    for (size_t i = n > whole ? n - whole : 0; i < n; i++)
        met += i >= first ? local[i] : 0;
    for (size_t i = n; i-- > 0;) {
        double near = i >= whole ? accumulated_error[i - whole] : 0,
               far = i > whole ? accumulated_error[i - whole - 1] : 0;
        double enters = i >= whole + first ? local[i - whole] : 0;
        double gain = cells > 1 && i >= first ? (met + part * enters) / cells : local[i];
        met += enters - (i >= first ? local[i] : 0);
        accumulated_error[i] = (i >= first ? (1 - part) * near + part * far : 0) + gain;
    }
}

void ehl_advect_error(ehl_march *m, double distance)
{
    const ehl_reynolds *r = m->solver->reynolds;
    const ehl_state *s = m->state;
    const double *y = m->trial.mass, *y0 = s[0].mass, *y1 = s[1].mass;
    detect_load_jump(m, distance);
    int across = m->distance_of_jump > 0 && m->scheme != EHL_EULER && m->smooth > 1 && m->known > 2;
    double time = m->trial_at.time, edge = start_of_accumulation(m), scale = 0, ahead = 0;
    if (across) {
        scale = m->trial_step.rate * (time - s[2].time);
        ahead = (time - s[0].time) / (s[0].time - s[1].time);
    }
    for (size_t i = 0; across && i < r->nodes; i++)
        if (m->local[i] < 0 || m->local[i] > 0)
            m->local[i] = error_at_kink(m->local[i], scale * m->local[i],
                                        (y[i] - y0[i] - ahead * (y0[i] - y1[i])) / y[i]);
    double first = ceil((edge - r->first) / r->dx);
    advect_and_add(m, first > 0 ? (size_t)first : 0, distance / r->dx);
}
