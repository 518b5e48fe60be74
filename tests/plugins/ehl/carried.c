/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the cells make of a film on its way, in one step of any length, against the sum over each
   cell of that way. */
#include "check.h"

#include "../../../plugins/ehl/errors/advected-error.h"

#include <math.h>
#include <stdio.h>

enum { NODES = 101, BEGIN = 20, END = 81 };

/* What a way of one cell makes of the mass at node i: the slope by differences of sixth order less
   (3 m_i - 4 m_(i-1) + m_(i-2))/2, which carries it. */
static double local_at(const double *mass, int i)
{
    const double *m = mass + i;
    double slope = (45 * (m[1] - m[-1]) - 9 * (m[2] - m[-2]) + m[3] - m[-3]) / 60;
    return (slope - (3 * m[0] - 4 * m[-1] + m[-2]) / 2) / m[0];
}

static double sum_on_way(const double *mass, int node, double cells)
{
    double sum = 0;
    for (int i = node; i >= BEGIN && cells > 0; i--, cells--)
        sum += fmin(cells, 1) * local_at(mass, i);
    return sum;
}

static void check_step(double cells)
{
    double mass[NODES], error[NODES] = {0}, room[NODES], off = 0, most = 0;
    for (int i = 0; i < NODES; i++)
        mass[i] = 1 + 0.3 * sin(0.3 * i) + (i > 50 ? 0.1 : 0);
    ehl_reynolds eq = {.nodes = NODES, .dx = 1, .wedge = 2};
    ehl_solver solver = {.reynolds = &eq};
    ehl_march m = {.solver = &solver, .known = 2, .at = {.entrainment = 1, .time = cells}};
    m.state[0].mass = mass;
    ehl_carried c = {.error = error, .room = room, .first = BEGIN, .end = END};
    const ehl_stretch stretch = {BEGIN, END};
    ehl_carried_add(&c, &m, &stretch);
    for (int i = BEGIN; i < END; i++) {
        off = fmax(off, fabs(ehl_carried_to(&c, (size_t)i) - sum_on_way(mass, i, cells)));
        most = fmax(most, fabs(sum_on_way(mass, i, cells)));
    }
    char what[64];
    snprintf(what, sizeof what, "%g cells at once", cells);
    check_below(what, off / most, 1e-12);
}

int main(void)
{
    static const double steps[] = {0.2, 1, 1.3, 2, 7.6, END - BEGIN - 0.5, END - BEGIN, 1e9};
    for (size_t k = 0; k < sizeof steps / sizeof steps[0]; k++)
        check_step(steps[k]);
    return check_done();
}
