/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks the gap of a film against the shape of its flanks and the deflection by its pressure. */
#include "balance.h"
#include "lanes.h"
#include "traces.h"

#include <math.h>

/* Returns the gap without roughness and what has yielded of it. */
static double smooth_gap(const ehl_march *m, size_t i)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *plastic = m->state[0].film.plastic;
    return eq->h[i] + (eq->rough ? eq->rough[i] : 0) - (plastic ? plastic[i] : 0);
}

/* Returns the same of all nodes. */
static const double *smooth_gaps(ehl_balance *b, const ehl_march *m)
{
    if (!m->solver->reynolds->rough && !m->state[0].film.plastic)
        return m->solver->reynolds->h;
    for (size_t i = 0; i < b->nodes; i++)
        b->left[i] = smooth_gap(m, i);
    return b->left;
}

/* Returns the sum of x p over n nodes, the first of which is at x; adds that of the gap times the
   rise of p to the node behind each to *work. */
FF_SIMD
static double moment_of(size_t n, const double *restrict p, const double *restrict gap, double x,
                        double dx, double *work)
{
    ehl_lanes moment = {0}, rise = {0}, place = {0, 1, 2, 3}, of[4];
    size_t i = 0;
    for (; i + EHL_LANES <= n; i += EHL_LANES, place += (double)EHL_LANES) {
        for (size_t k = 0; k < 2; k++) {
            memcpy(&of[k], p + i + k, sizeof of[k]);
            memcpy(&of[2 + k], gap + i + k, sizeof of[k]);
        }
        moment += (x + place * dx) * of[0];
        rise += (of[2] + of[3]) / 2 * (of[1] - of[0]);
    }
    for (; i < n; i++) {
        moment[0] += (x + (double)i * dx) * p[i];
        rise[0] += (gap[i] + gap[i + 1]) / 2 * (p[i + 1] - p[i]);
    }
    *work += ehl_lanes_sum(&rise);
    return ehl_lanes_sum(&moment);
}

/* Checks u_r int h dp/dx dx against the moment of the pressure, -(1/R) int x p dx: the deflection
   by a pressure adds nothing to it. The first and the last gap are not those of the flanks where
   they are rough. */
void ehl_balance_moment(ehl_balance *b, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = m->state[0].film.p, *gap = smooth_gaps(b, m);
    size_t n = b->nodes, centre = (size_t)fmin(fmax(ceil(-eq->first / eq->dx), 0), (double)n - 1);
    double middle = eq->first + (double)centre * eq->dx, work = 0,
           before = moment_of(centre, p, gap, eq->first, eq->dx, &work),
           behind = moment_of(n - 1 - centre, p + centre, gap + centre, middle, eq->dx, &work);
    double scale = eq->dx / m->step.radius;
    b->moment = behind + before;
    b->arm = behind - before;
    if (!(b->arm <= 0)) /* as well where it is no number */
        ehl_worse(&b->worst.moment, fabs(work + scale * b->moment) / (scale * b->arm));
}

/* Returns how far h is off the shape of the flanks, rough ones where their traces stand, except for
   a part that is the same at all nodes, m. */
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
    for (size_t i = 1; i + 1 < b->nodes; i++)
        least = eq->h[i] < eq->h[least] ? i : least;
    double there = gap_off_shape(b, m, least);
    if (!m->solver->outside) /* whose h00 may be counted from elsewhere */
        ehl_worse(&b->worst.gap, fabs(there - m->state[0].film.h00) / eq->h[least]);
    for (size_t k = 0; k < sizeof places / sizeof places[0]; k++) {
        double node = (places[k] * fmax(a, 4 * g->dx) - eq->first) / eq->dx;
        if (node >= 1 && node + 2 < (double)b->nodes) {
            size_t i = (size_t)node;
            ehl_worse(&b->worst.gap, fabs(gap_off_shape(b, m, i) - there) / eq->h[i]);
        }
    }
}
