/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks the gap of a film against the shape of its flanks and the deflection by its pressure. */
#include "../contact/roughness-check.h"
#include "../contact/simd-reductions.h"
#include "balance.h"

#include <math.h>

/* Returns the gap without roughness and without its plastic part. */
static double smooth_gap(const ehl_march *m, size_t i)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *plastic = m->state[0].film.plastic;
    return eq->h[i] + (eq->rough ? eq->rough[i] : 0) - (plastic ? plastic[i] : 0);
}

/* Returns the smooth gaps of all nodes. */
static const double *smooth_gaps(ehl_balance *b, const ehl_march *m)
{
    if (!m->solver->reynolds->rough && !m->state[0].film.plastic)
        return m->solver->reynolds->h;
    for (size_t i = 0; i < b->nodes; i++)
        b->left[i] = smooth_gap(m, i);
    return b->left;
}

typedef struct moments {
    double load, moment, arm; /* sums of p, x p and |x p| */
    double rise;              /* sum of p times the increase of the gap over both cells */
} moments;

/* Returns these sums over the nodes that have a neighbour on each side. The first of them is at
   x. */
FF_SIMD
static moments moments_of(size_t n, const double *restrict p, const double *restrict gap, double x,
                          double dx)
{
    ehl_lanes load = {0}, moment = {0}, arm = {0}, rise = {0}, here, before, behind,
              place = {x, x + dx, x + 2 * dx, x + 3 * dx};
    size_t i = 1;
    for (; i + EHL_LANES < n; i += EHL_LANES, place += EHL_LANES * dx) {
        memcpy(&here, p + i, sizeof here);
        memcpy(&before, gap + i - 1, sizeof before);
        memcpy(&behind, gap + i + 1, sizeof behind);
        load += here;
        rise += here * (behind - before);
        here *= place;
        moment += here;
        arm += (ehl_lanes)((ehl_lanes_bits)here & INT64_MAX); /* absolute value */
    }
    moments sum = {ehl_lanes_sum(&load), ehl_lanes_sum(&moment), ehl_lanes_sum(&arm),
                   ehl_lanes_sum(&rise)};
    for (; i + 1 < n; i++) {
        double turn = (x + (double)(i - 1) * dx) * p[i];
        sum.load += p[i];
        sum.moment += turn;
        sum.arm += fabs(turn);
        sum.rise += p[i] * (gap[i + 1] - gap[i - 1]);
    }
    return sum;
}

/* Checks -int h dp/dx dx = int p dh/dx dx (p is 0 at both ends) against the moment of the pressure,
   (1/R) int x p dx: the deflection by a pressure does not contribute. With rough flanks the first
   and the last gap are not those of the flanks. */
void ehl_balance_moment(ehl_balance *b, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = m->state[0].film.p;
    moments sum = moments_of(b->nodes, p, smooth_gaps(b, m), eq->first + eq->dx, eq->dx);
    double scale = eq->dx / m->step.radius;
    b->load = (sum.load + p[0] + p[b->nodes - 1]) * eq->dx + m->state[0].film.ahead;
    b->moment = sum.moment;
    b->arm = sum.arm;
    if (!(b->arm <= 0)) /* also if it is not a number */
        ehl_worse(&b->worst.moment, fabs(sum.rise / 2 - scale * b->moment) / (scale * b->arm));
}

/* Returns the difference of h from the shape of the flanks (including the current position of their
   roughness), except for a constant that is equal at all nodes, m. */
static double gap_off_shape(const ehl_balance *b, const ehl_march *m, size_t i)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = m->state[0].film.p;
    double x = eq->first + (double)i * eq->dx, gap = smooth_gap(m, i);
    if (m->rough)
        gap += ehl_traces_height(m->rough, x, eq->dx, m->at.time) - eq->rough[i];
    return gap - x * x / (2 * m->step.radius) - ehl_dot(b->nodes, b->kernel - i, p);
}

void ehl_balance_gap(ehl_balance *b, const ehl_march *m)
{
    static const double places[] = {-1, -0.6, -0.2, 0.3, 0.7, 0.95};
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_grid *g = m->solver->grid;
    double a = ehl_hertz_half_width(m->at.load, m->at.radius, m->history->modulus);
    size_t least = 1;
    for (double h = ehl_least(b->nodes - 2, eq->h + 1); eq->h[least] > h;)
        least++;
    double there = gap_off_shape(b, m, least);
    if (!m->solver->outside) /* the discretisation of another stage may define h00 differently */
        ehl_worse(&b->worst.gap, fabs(there - m->state[0].film.h00) / eq->h[least]);
    for (size_t k = 0; k < sizeof places / sizeof places[0]; k++) {
        double node = (places[k] * fmax(a, 4 * g->dx) - eq->first) / eq->dx;
        if (node >= 1 && node + 2 < (double)b->nodes) {
            size_t i = (size_t)node;
            ehl_worse(&b->worst.gap, fabs(gap_off_shape(b, m, i) - there) / eq->h[i]);
        }
    }
}
