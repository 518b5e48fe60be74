/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "error-transport.h"

#include <flankfilm/simd.h>

#include <stdlib.h>
#include <string.h>

ff_status ehl_transport_create(ehl_transport *t, size_t nodes)
{
    *t = (ehl_transport){.nodes = nodes, .accuracy = 0.03};
    double *next = t->memory = calloc(EHL_TRANSPORT_ARRAYS * nodes, sizeof *next);
    if (!next)
        return FF_NOMEM;
    double **own[EHL_TRANSPORT_ARRAYS] = {&t->e.p,     &t->e.v,    &t->h,    &t->tau,
                                          &t->rows,    &t->rest,   &t->flow, &t->mass[0],
                                          &t->mass[1], &t->mass[2]};
    for (size_t k = 0; k < EHL_TRANSPORT_ARRAYS; k++, next += nodes)
        *own[k] = next;
    return FF_OK;
}

void ehl_transport_destroy(ehl_transport *t)
{
    free(t->memory);
    t->memory = NULL;
}

void ehl_transport_restart(ehl_transport *t)
{
    memset(t->memory, 0, EHL_TRANSPORT_ARRAYS * t->nodes * sizeof *t->memory);
    t->e.h00 = 0;
    t->last_step = 0;
    t->blind = 0;
    t->known = 0;
}

/* Computes the pressure flow from each node to the one `stride` cells further, with the mobility of
 * face_mobilities (reynolds.c). */
FF_SIMD
static void pressure_flow(size_t faces, size_t stride, double dx, const double *restrict f,
                          const double *restrict p, double *restrict flow)
{
    const double per = 0.5 / ((double)(int)stride * dx);
    FF_SIMD_LOOP
    for (size_t i = 0; i < faces; i++) {
        double a = f[i], b = f[i + stride], sum = a + b, s = 4 * a * b / (sum * sum);
        double share = sum > 0 ? 1 - 0.5 * s * (1 - s) : 0;
        flow[i] = per * share * sum * (p[i + stride] - p[i]);
    }
}

/* tau += factor times the flow that a node gains from its faces, which lie `stride` apart. */
FF_SIMD
static void add_gain(size_t from, size_t to, size_t stride, double factor,
                     const double *restrict flow, double *restrict tau)
{
    const double per = factor / (double)(int)stride;
    for (size_t i = from; i < to; i++)
        tau[i] += per * (flow[i] - flow[i - stride]);
}

/* tau += the wedge minus -u dm/dx, where dm/dx comes from differences of fourth order. */
FF_SIMD
static void add_wedge_error(size_t from, size_t to, double u, double bend, const double *restrict m,
                            double *restrict tau)
{
    for (size_t i = from; i < to; i++) {
        double rise = m[i] - m[i - 1], before = m[i - 1] - m[i - 2];
        double slope = (8 * (m[i + 1] - m[i - 1]) - (m[i + 2] - m[i - 2])) / 12;
        tau[i] += u * (slope - rise - bend * (rise - before));
    }
}

/* No difference reaches across the edge of the film. */
FF_SIMD
static void leave_out_edges(size_t from, size_t to, const unsigned char *restrict full,
                            double *restrict tau)
{
    for (size_t i = from; i < to; i++)
        tau[i] = full[i - 1] & full[i] & full[i + 1] & full[i + 2] & full[i + 3] ? tau[i] : 0;
}

/*
 * Adds what the last volume of the film leaves out. Where it balances p(i-1) - 2 p(i) = c dx^2, its
 * solution is the parabola that ends (s + 1/2) dx behind node i, with s = p(i)/(c dx^2), less
 * c dx^2 (s - 1/2)^2/2 at all nodes (docs/theory.md, 7.16).
 */
static void add_end(const ehl_reynolds *r, const ehl_film *film, double *tau)
{
    const double *p = ehl_fluid(r, film);
    for (size_t i = 2; i < r->last && !r->conserving; i++) {
        double bend = p[i - 1] - 2 * p[i];
        if (!film->full[i] || film->full[i + 1] || !(p[i] < bend))
            continue;
        double off = p[i] / bend - 0.5;
        tau[i] -= r->f[i] / r->dx * bend * off * off / 2;
    }
}

/*
 * tau of the cells. The balances of the pressure flow over 1, 2 and 3 cells, 3/2, -3/5 and 1/10 of
 * which are the exact one but for dx^6: what the first one has beyond that.
 */
static void truncate_cells(ehl_transport *t, const ehl_reynolds *r, const ehl_step *step,
                           const ehl_film *film)
{
    enum { REACH = 3 };
    static const double share[REACH] = {1 - 1.5, 0.6, -0.1};
    const size_t n = t->nodes, end = r->last + REACH < n ? r->last : n - REACH;
    memset(t->tau, 0, n * sizeof *t->tau);
    for (size_t k = 0; k < REACH; k++) {
        size_t stride = k + 1, faces = r->last + 1 > stride ? r->last + 1 - stride : 0;
        pressure_flow(faces, stride, r->dx, r->f, ehl_fluid(r, film), t->flow);
        for (size_t i = faces; i < end; i++) /* no pressure reaches so far */
            t->flow[i] = 0;
        add_gain(REACH, end, stride, share[k], t->flow, t->tau);
    }
    leave_out_edges(REACH, end, film->full, t->tau);
    add_wedge_error(REACH, end, step->entrainment, r->wedge == 2 ? 0.5 : 0,
                    r->carry ? r->carried : r->mass, t->tau);
    add_end(r, film, t->tau);
}

/* rows = -tau + dx (c1 e1 + c2 e2) + share rest, where e1 and e2 are the errors of earlier masses.
 */
FF_SIMD
static void fill_rows(size_t n, const double *restrict tau, double c1, const double *restrict e1,
                      double c2, const double *restrict e2, double share,
                      const double *restrict rest, double *restrict rows)
{
    for (size_t i = 0; i < n; i++)
        rows[i] = c1 * e1[i] + c2 * e2[i] - tau[i] + share * rest[i];
}

/* Returns the share of what the last solution has left of its right-hand side that is added to this
 * one. As a flow it counts over the length of its step. Otherwise the oil would gather all of it on
 * its way. */
static double what_was_left(const ehl_march *m, const ehl_transport *t)
{
    double dt = m->trial_at.time - m->state[0].time;
    return m->known > 0 && t->last_step > 0 ? t->last_step / dt : 0;
}

FF_SIMD
static void add_h00(size_t n, const double *restrict v, double h00, double *restrict h)
{
    for (size_t i = 0; i < n; i++)
        h[i] = v[i] + h00;
}

/* mass = rho h + h drho/dp p, for the errors of h and p. */
FF_SIMD
static void fill_mass(size_t n, const double *restrict rho, const double *restrict rho_p,
                      const double *restrict gap, const double *restrict h,
                      const double *restrict p, double *restrict mass)
{
    for (size_t i = 0; i < n; i++)
        mass[i] = rho[i] * h[i] + rho_p[i] * gap[i] * p[i];
}

/* Fills in the errors of the gap and of the mass, which is the unknown of a cavitated node. */
static void spread(const ehl_march *m, ehl_transport *t)
{
    const ehl_reynolds *r = m->solver->reynolds;
    const ehl_film *film = &m->trial.film;
    const ehl_liquid *q = &r->liquid;
    double *mass = t->mass[0];
    add_h00(t->nodes, t->e.v, t->e.h00, t->h);
    fill_mass(r->last + 1, q->rho, q->rho_p, r->h, t->h, t->e.p, mass);
    for (size_t i = r->last + 1; i < t->nodes; i++)
        mass[i] = r->mass[i] / r->h[i] * t->h[i];
    for (size_t i = 1; r->conserving && i + 1 < t->nodes; i++)
        if (ehl_is_cavitated(r, film, i))
            mass[i] = r->unit * t->e.p[i];
}

/* Returns 1 if the equations are near enough to those of the trial: the last step of Newton's
 * method has changed it by little more than its tolerance, and has not moved its end. */
static int is_evaluated(const ehl_march *m)
{
    const ehl_reynolds *r = m->solver->reynolds;
    return m->evaluated && m->trial.film.full[r->last - 1];
}

/* Half-widths of the largest contact within which the oil leaves it: with its inlet some 3. */
static const double PASSAGE = 4;

/* Accuracy of the first film's errors, over that of the others, which begin with a guess. */
static const double FIRST_ACCURACY = 0.3;

void ehl_transport_step(ehl_march *m)
{
    ehl_transport *t = m->transport;
    ehl_reynolds *r = m->solver->reynolds;
    const ehl_film *film = &m->trial.film;
    double c[3] = {0, 0, 0}, *oldest = t->mass[EHL_STATES - 1];
    if (!is_evaluated(m)) {
        ehl_reynolds_evaluate(r, &m->trial_step, film);
        ehl_reynolds_slopes(r, &m->trial_step, film);
    }
    truncate_cells(t, r, &m->trial_step, film);
    if (m->known > 0)
        ehl_march_factors(m, m->trial_at.time, c);
    fill_rows(t->nodes, t->tau, r->dx * c[1], t->mass[0], r->dx * c[2], t->mass[1],
              what_was_left(m, t), t->rest, t->rows);
    ff_status status = ehl_linear_answer(m->solver, &m->trial_step, film, t->rows,
                                         m->known > 0 ? t->accuracy : FIRST_ACCURACY * t->accuracy,
                                         &t->e, t->rest);
    memmove(t->mass + 1, t->mass, (EHL_STATES - 1) * sizeof t->mass[0]);
    t->mass[0] = oldest;
    spread(m, t);
    t->last_step = m->known > 0 ? m->trial_at.time - m->state[0].time : 0;
    t->blind -= m->trial_step.entrainment * t->last_step;
    if (status != FF_OK) { /* the errors of later films would be made of numbers that are none */
        ehl_transport_restart(t);
        t->blind = PASSAGE * m->solver->grid->half_width;
    }
    t->known = !(t->blind > 0);
}
