/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "advected-error.h"

#include "../contact/simd-reductions.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <string.h>

ehl_stretch ehl_carrying_stretch(const ehl_reynolds *eq, double a, double buildup)
{
    return (ehl_stretch){(buildup - a - eq->first) / eq->dx,
                         (a - 1.6 * buildup - eq->first) / eq->dx};
}

int ehl_carrying_order(const ehl_reynolds *eq)
{
    return eq->asymmetric && eq->conserving ? 1 : eq->wedge;
}

/* Weights of the nodes i-3 to i+3. */
typedef struct stencil {
    double of[7];
} stencil;

/* Returns the error that the upwind difference adds to the film while the oil moves by one cell:
   the slope from differences of sixth order minus the slope from the upwind difference. For volumes
   from node to node, whose change in time includes both nodes, it is the leading error: dx^2/12
   h_xxx, or dx/2 h_xx. */
static stencil local_error(const ehl_reynolds *eq)
{
    if (eq->asymmetric && eq->conserving)
        return (stencil){{0, 0, 1. / 2, -1, 1. / 2, 0, 0}};
    if (eq->asymmetric && eq->wedge == 2)
        return (stencil){{0, 0, -1. / 12, 3. / 12, -3. / 12, 1. / 12, 0}};
    if (eq->wedge == 2)
        return (stencil){{-1. / 60, -21. / 60, 75. / 60, -90. / 60, 45. / 60, -9. / 60, 1. / 60}};
    return (stencil){{-1. / 60, 9. / 60, 15. / 60, -60. / 60, 45. / 60, -9. / 60, 1. / 60}};
}

FF_SIMD
static void add_local(size_t n, const double *restrict mass, double cells, const stencil *s,
                      double *restrict error)
{
    const double c0 = s->of[0], c1 = s->of[1], c2 = s->of[2], c3 = s->of[3], c4 = s->of[4],
                 c5 = s->of[5], c6 = s->of[6];
    for (size_t i = 0; i < n; i++) {
        const double *m = mass + i;
        double off =
            c0 * m[-3] + c1 * m[-2] + c2 * m[-1] + c3 * m[0] + c4 * m[1] + c5 * m[2] + c6 * m[3];
        error[i] += cells * off / m[0];
    }
}

/* Adds to each node the errors that its oil has accumulated over the last `cells` cells; node j
   contributes local[j]. Oil from upstream of the stretch has only errors from inside it. Replaces
   `local` by its running sums. */
static void add_way(size_t n, double *restrict local, double cells, double *restrict error)
{
    const size_t whole = (size_t)fmin(cells, (double)n);
    const double part = cells - (double)whole;
    double met = 0;
    for (size_t i = 0; i < n; i++)
        local[i] = met += local[i];
    for (size_t i = 0; i < whole; i++)
        error[i] += local[i];
    for (size_t i = whole; i < n; i++) {
        double in_front = local[i - whole], further = i > whole ? local[i - whole - 1] : 0;
        error[i] += local[i] - in_front + part * (in_front - further);
    }
}

/* Adds the errors due to the cells while the oil moves by that number of cells. */
static void add_moved(ehl_carried *c, const double *mass, double cells, const stencil *s)
{
    const size_t n = c->end - c->first;
    if (cells <= 1) {
        add_local(n, mass + c->first, cells, s, c->error + c->first);
        return;
    }
    memset(c->room, 0, n * sizeof *c->room);
    add_local(n, mass + c->first, 1, s, c->room);
    add_way(n, c->room, cells, c->error + c->first);
}

/* Sets the nodes of the stretch. All errors upstream of it are 0. */
static void place(ehl_carried *c, const ehl_stretch *s, size_t nodes)
{
    enum { REACH = 3 }; /* number of nodes of the stencil on either side */
    double first = fmax(ceil(s->begin), REACH), end = fmin(s->end, (double)nodes - REACH);
    size_t before = c->first;
    c->first = end > first ? (size_t)first : 0;
    c->end = end > first ? (size_t)end : 0;
    if (c->first > before)
        memset(c->error + before, 0, (c->first - before) * sizeof *c->error);
}

/* The errors are large in dips that are a few cells wide. They move with the oil by whole cells, so
   that they do not spread. */
void ehl_carried_add(ehl_carried *c, const ehl_march *m, const ehl_stretch *s)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    size_t n = eq->nodes - c->first;
    double *error = c->error + c->first;
    double cells = m->at.entrainment * (m->at.time - c->time) / eq->dx;
    int goes_on = m->known > 1 && c->mirrored == m->mirrored && cells >= 0;
    c->time = m->at.time;
    c->mirrored = m->mirrored;
    c->part = goes_on ? c->part + cells : 0;
    size_t whole = goes_on && c->part < (double)n ? (size_t)c->part : n;
    memmove(error + whole, error, (n - whole) * sizeof *error);
    memset(error, 0, whole * sizeof *error);
    c->part -= floor(c->part);
    place(c, s, eq->nodes);
    stencil local = local_error(eq);
    if (goes_on)
        add_moved(c, m->state[0].mass, cells, &local);
}

double ehl_carried_to(const ehl_carried *c, size_t node)
{
    return c->end > 0 ? c->error[node < c->end ? node : c->end - 1] : 0;
}

/* Returns the smallest value of h (1 - error). */
FF_SIMD
static double least_without(size_t n, const double *restrict h, const double *restrict error)
{
    ehl_lanes least = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL}, here, off;
    size_t i = 0;
    for (; i + EHL_LANES <= n; i += EHL_LANES) {
        memcpy(&here, h + i, sizeof here);
        memcpy(&off, error + i, sizeof off);
        here *= 1 - off;
        ehl_lanes_keep_least(&least, &here);
    }
    double lowest = ehl_lanes_least(&least);
    for (; i < n; i++)
        lowest = ehl_lesser(h[i] * (1 - error[i]), lowest);
    return lowest;
}

double ehl_carried_of_least(const ehl_carried *c, size_t nodes, const double *h, double least)
{
    double without = least_without(c->end, h, c->error),
           behind = ehl_least(nodes - c->end, h + c->end) * (1 - ehl_carried_to(c, nodes));
    return fabs(fmin(without, behind) / least - 1);
}
