/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "error-transport.h"

#include "../equations/asperities.h"

#include <flankfilm/simd.h>

#include <stdlib.h>
#include <string.h>

ff_status ehl_transport_create(ehl_transport *t, size_t nodes)
{
    *t = (ehl_transport){.nodes = nodes, .accuracy = 1e-2};
    double *next = t->memory = calloc(EHL_TRANSPORT_ARRAYS * nodes, sizeof *next);
    if (!next)
        return FF_NOMEM;
    for (size_t k = 0; k < EHL_CAUSES; k++) {
        ehl_film_error *e = &t->of[k];
        double **own[EHL_ERROR_ARRAYS - EHL_STATES] = {&e->now.p, &e->now.v, &e->before.p,
                                                       &e->before.v, &e->h};
        for (size_t j = 0; j < EHL_ERROR_ARRAYS - EHL_STATES; j++, next += nodes)
            *own[j] = next;
        for (size_t j = 0; j < EHL_STATES; j++, next += nodes)
            e->mass[j] = next;
    }
    double **own[EHL_SHARED_ARRAYS] = {&t->tau, &t->rows, &t->flow};
    for (size_t k = 0; k < EHL_SHARED_ARRAYS; k++, next += nodes)
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
    for (size_t k = 0; k < EHL_CAUSES; k++)
        t->of[k].now.h00 = t->of[k].before.h00 = 0;
    t->last_step = 0;
    t->known = t->lost = 0;
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

/* Divided differences of the mass over the newest times: third with 4 of them, second with 3. */
typedef struct divided {
    double of[EHL_STATES + 1];
} divided;

static divided differences(const double *time, size_t count)
{
    divided d = {{0}};
    for (size_t i = 0; i < count; i++) {
        d.of[i] = 1;
        for (size_t k = 0; k < count; k++)
            d.of[i] *= k == i ? 1 : 1 / (time[i] - time[k]);
    }
    return d;
}

FF_SIMD
static void add_difference(size_t n, const double *restrict of, const double *restrict m0,
                           const double *restrict m1, const double *restrict m2,
                           const double *restrict m3, double factor, double *restrict to)
{
    const double c0 = factor * of[0], c1 = factor * of[1], c2 = factor * of[2], c3 = factor * of[3];
    for (size_t i = 0; i < n; i++)
        to[i] += c0 * m0[i] + c1 * m1[i] + c2 * m2[i] + c3 * m3[i];
}

/*
 * tau of the steps: (10.2) takes the change in time by dt (dt + dt_1) of the third divided
 * difference of the mass too small, (10.1) by dt of the second. The step behind a restart is one of
 * (10.1); what it leaves, dt^2 of the second difference, is known one step later.
 */
static void truncate_steps(const ehl_march *m, ehl_transport *t)
{
    const ehl_reynolds *r = m->solver->reynolds;
    const ehl_state *s = m->state;
    const double now = m->trial_at.time, time[] = {now, s[0].time, s[1].time, s[2].time};
    const int euler = m->scheme == EHL_EULER;
    memset(t->tau, 0, t->nodes * sizeof *t->tau);
    size_t count = euler ? 3 : 4;
    double factor = r->dx * (now - time[1]) * (euler ? 1 : now - time[2]), *to = t->tau;
    if (!euler && m->smooth == 2) {
        count = 3;
        factor = (time[1] - time[2]) * (time[1] - time[2]);
        to = t->of[EHL_BY_STEPS].mass[0];
    }
    if (m->smooth + 1 < count || m->known + 1 < count)
        return;
    divided d = differences(time, count);
    add_difference(t->nodes, d.of, r->mass, s[0].mass, s[1].mass, s[2].mass, factor, to);
}

/* rows = -tau + dx (c1 e1 + c2 e2), where e1 and e2 are the errors of earlier masses. */
FF_SIMD
static void fill_rows(size_t n, const double *restrict tau, double c1, const double *restrict e1,
                      double c2, const double *restrict e2, double *restrict rows)
{
    for (size_t i = 0; i < n; i++)
        rows[i] = c1 * e1[i] + c2 * e2[i] - tau[i];
}

/* Extrapolates x in a straight line, and sets `before` to the old x. */
FF_SIMD
static void go_on(size_t n, double ahead, double *restrict x, double *restrict before)
{
    for (size_t i = 0; i < n; i++) {
        double now = x[i];
        x[i] = now + ahead * (now - before[i]);
        before[i] = now;
    }
}

static void guess(const ehl_march *m, const ehl_transport *t, ehl_film_error *e)
{
    double dt = m->trial_at.time - m->state[0].time;
    double ahead = t->last_step > 0 && m->smooth > 1 ? dt / t->last_step : 0;
    go_on(t->nodes, ahead, e->now.p, e->before.p);
    go_on(t->nodes, ahead, e->now.v, e->before.v);
    go_on(1, ahead, &e->now.h00, &e->before.h00);
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
static void spread(const ehl_march *m, const ehl_transport *t, ehl_film_error *e)
{
    const ehl_reynolds *r = m->solver->reynolds;
    const ehl_film *film = &m->trial.film;
    const ehl_liquid *q = &r->liquid;
    double *mass = e->mass[0];
    add_h00(t->nodes, e->now.v, e->now.h00, e->h);
    fill_mass(r->last + 1, q->rho, q->rho_p, r->h, e->h, e->now.p, mass);
    for (size_t i = 0; r->touching && i <= r->last;
         i++) /* the asperities' part of p is not oil's */
        mass[i] -= q->rho_p[i] * r->h[i] * r->p_a_h[i] * e->h[i];
    for (size_t i = r->last + 1; i < t->nodes; i++)
        mass[i] = r->mass[i] / r->h[i] * e->h[i];
    for (size_t i = 1; r->conserving && i + 1 < t->nodes; i++)
        if (ehl_is_cavitated(r, film, i))
            mass[i] = r->unit * e->now.p[i];
}

/* Finds the errors by one cause whose tau is known. */
static ff_status find(ehl_march *m, ehl_transport *t, int cause)
{
    ehl_film_error *e = &t->of[cause];
    double c[3] = {0, 0, 0}, *oldest = e->mass[EHL_STATES - 1], dx = m->solver->reynolds->dx;
    if (m->known > 0)
        ehl_march_factors(m, m->trial_at.time, c);
    fill_rows(t->nodes, t->tau, dx * c[1], e->mass[0], dx * c[2], e->mass[1], t->rows);
    guess(m, t, e);
    const ehl_accuracy accuracy = {t->accuracy, {&t->of[EHL_BY_CELLS].now, &e->now}};
    ff_status status =
        ehl_linear_answer(m->solver, &m->trial_step, &m->trial.film, t->rows, &accuracy, &e->now);
    memmove(e->mass + 1, e->mass, (EHL_STATES - 1) * sizeof e->mass[0]);
    e->mass[0] = oldest;
    spread(m, t, e);
    return status;
}

void ehl_transport_step(ehl_march *m)
{
    ehl_transport *t = m->transport;
    ehl_reynolds *r = m->solver->reynolds;
    const ehl_film *film = &m->trial.film;
    if (t->lost) /* later errors would be made of numbers that are none */
        return;
    ehl_reynolds_evaluate(r, &m->trial_step, film);
    ehl_reynolds_slopes(r, &m->trial_step, film);
    if (r->statistical.law)
        ehl_statistical_rows(r, film);
    truncate_cells(t, r, &m->trial_step, film);
    ff_status status = find(m, t, EHL_BY_CELLS);
    if (status == FF_OK && m->known > 0) {
        truncate_steps(m, t);
        status = find(m, t, EHL_BY_STEPS);
    }
    t->last_step = m->known > 0 ? m->trial_at.time - m->state[0].time : 0;
    t->lost |= status != FF_OK;
    t->known = !t->lost;
}
