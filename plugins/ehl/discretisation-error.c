/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of a film by the cells, by the time steps and by the ends of the domain. */
#include "results.h"

#include <math.h>

/*
 * Cells over the length in which the pressure of the inlet rises: where the Hertzian gap in front
 * of the contact has grown by h (Greenwood 1972), and not longer than sqrt(2 R h).
 */
static double resolution(const ff_march *m, double h)
{
    double radius = m->at.radius;
    double a = ff_hertz_half_width(m->at.load, radius, m->history->modulus);
    double sharp = a * pow(3 / (2 * sqrt(2)) * h * radius / (a * a), 2. / 3);
    return fmin(sharp, sqrt(2 * radius * h)) / m->solver->grid->dx;
}

/* Errors as shares: by the cells and by the time steps. */
typedef struct errors {
    double space, time;
} errors;

/*
 * Error of a film by the cells, relative: (base + by_square L^2 + by_L L) over the square of the
 * cells over the inlet's pressure rise, or over their number with the first-order wedge. The
 * factors cover the solutions on 512 cells with M 2 to 200 and L 0 to 15; L is that of Moes.
 */
typedef struct in_space {
    double base, by_L, by_square, first_base, first_by_L;
} in_space;

static const in_space of_h_min = {0.16, 0, 0.0063, 0.4, 0.012},
                      of_h_central = {0.2, 0.05, 0, 0.4, 0.02};

static double space_error(const ff_march *m, const in_space *c, double cells)
{
    const ff_oil *oil = &m->solver->reynolds->oil;
    double modulus = m->history->modulus;
    double U = oil->viscosity * m->at.entrainment / (modulus * m->at.radius);
    double L = oil->alpha * modulus * pow(2 * U, 0.25);
    if (m->solver->reynolds->wedge == 2)
        return fmin(1, (c->base + c->by_L * L + c->by_square * L * L) / (cells * cells));
    return fmin(1, (c->first_base + c->first_by_L * L) / cells);
}

/* Largest sum of truncations that the film carries near that node. */
static double drift_near(const ff_march *m, size_t node)
{
    enum { NEAR = 4 };
    size_t n = m->solver->grid->nodes, from = node > NEAR ? node - NEAR : 0;
    double worst = 0;
    for (size_t i = from; i < n && i <= node + NEAR; i++)
        worst = fmax(worst, fabs(m->drift[i]));
    return worst;
}

/* How well the grid resolves the contact and its inlet. */
static void record_resolution(ff_results *r, const ff_march *m, double h_central, double cells)
{
    const ff_grid *g = m->solver->grid;
    double radius = m->at.radius, a = ff_hertz_half_width(m->at.load, radius, m->history->modulus);
    double length = sqrt(2 * radius * h_central), lengths = (g->inlet - a) / length;
    r->least_resolution = fmin(r->least_resolution, cells);
    r->least_inlet = fmin(r->least_inlet, lengths);
    r->worst_starvation =
        fmax(r->worst_starvation, fmin(1, ff_inlet_shortfall(a, length, lengths)));
    r->least_cells = fmin(r->least_cells, fmax(a, length) / g->dx);
}

static void worse(double *worst, double value)
{
    *worst = fmax(*worst, value);
}

/* Error of p_max by the cells: a spike as narrow as a cell is cut, the highest as well as one that
   might rise above it. Where its tip lies midway between two nodes, what is cut is what the upper
   of them stands out from its neighbours, if the flanks are straight, and 2.7 times that, if they
   are square roots: twice is taken. */
static void record_peaks(ff_results *r, const ff_march *m, double p_max)
{
    const double *p = m->state[0].film.p;
    if (!(p_max > 0))
        return;
    for (size_t i = 1; i + 1 < r->nodes; i++)
        if (p[i] >= p[i - 1] && p[i] >= p[i + 1])
            r->worst_peak = fmax(r->worst_peak, (3 * p[i] - p[i - 1] - p[i + 1]) / p_max - 1);
}

void ff_results_errors(ff_results *r, const ff_march *m, size_t node, double h_central,
                       double p_max)
{
    const ff_grid *g = m->solver->grid;
    errors least = {.time = drift_near(m, node)},
           central = {.time = drift_near(m, (size_t)(g->inlet / g->dx + 0.5))};
    if (m->step.loaded && m->step.load >= 0.02 * m->history->load_max) {
        double cells = resolution(m, h_central);
        record_resolution(r, m, h_central, cells);
        least.space = space_error(m, &of_h_min, cells);
        central.space = space_error(m, &of_h_central, cells);
        worse(&r->worst_in_time, least.time);
        worse(&r->worst_in_space, least.space);
        worse(&r->worst_central_in_time, central.time);
        worse(&r->worst_central_in_space, central.space);
        record_peaks(r, m, p_max);
    }
    r->row[FF_EHL_H_MIN_ERROR] = (least.time + least.space) * r->row[FF_EHL_H_MIN];
    r->row[FF_EHL_H_CENTRAL_ERROR] = (central.time + central.space) * r->row[FF_EHL_H_CENTRAL];
}
