/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The truncation errors of the time steps, and their sum along the path of the film through the
   contact. */
#include "truncation.h"

#include "../contact/simd-reductions.h"

#include <math.h>
#include <string.h>

/* Truncation errors count where the pressure exceeds this share of the highest pressure. */
static const double CONTACT_PRESSURE = 0.02;

/* The outlet is crossed once the oil has moved by as many build-up lengths; the pressure flow then
   has determined the film anew. */
static const double OUTLET_LENGTH = 2;

/* local = scale - (c[0] y0 + c[1] y1 + c[2] y2)/y where p exceeds `least`, and 0 elsewhere. */
FF_SIMD
static void fill_local(size_t n, const double *restrict y, const double *restrict y0,
                       const double *restrict y1, const double *restrict y2,
                       const double *restrict p, double least, const double *c, double scale,
                       double *restrict local)
{
    const double c0 = c[0], c1 = c[1], c2 = c[2];
    for (size_t i = 0; i < n; i++) {
        double off = scale - (c0 * y0[i] + c1 * y1[i] + c2 * y2[i]) / y[i];
        local[i] = p[i] > least ? off : 0;
    }
}

/* Estimates the error of the difference formula from a polynomial of the next higher order. Its
   leading term is the difference between the new film and the extrapolation of the old ones, (y -
   y_extrapolated)/(rate (t - t_oldest)). */
void ehl_estimate_truncation(ehl_march *m)
{
    size_t n = m->solver->grid->nodes, order = m->scheme == EHL_EULER || m->smooth < 2 ? 2 : 3;
    double time = m->trial_at.time, c[3];
    if (m->rough || ehl_run_of_states(m, m->trial_step.loaded, order) < order) {
        memset(m->local, 0, n * sizeof *m->local);
        return;
    }
    ehl_lagrange_factors(m, time, order, c);
    double scale = 1 / (m->trial_step.rate * (time - m->state[order - 1].time));
    for (size_t k = 0; k < 3; k++)
        c[k] *= scale;
    fill_local(n, m->trial.mass, m->state[0].mass, m->state[1].mass, m->state[2].mass,
               m->trial.film.p, CONTACT_PRESSURE * m->trial.highest, c, scale, m->local);
}

double ehl_march_truncation(const ehl_march *m)
{
    return ehl_greatest_size(m->solver->grid->nodes, m->local);
}

double ehl_outlet_begins(const ehl_reynolds *eq, double a, double buildup)
{
    return (a - 1.6 * buildup - eq->first) / eq->dx;
}

double ehl_truncation_sum(const ehl_march *m, double time)
{
    double load = m->trial_at.load, radius = m->trial_at.radius, h = m->trial.thinnest;
    if (!m->trial_step.loaded || !(load > 0 && h > 0))
        return time * ehl_march_truncation(m);
    double a = ehl_hertz_half_width(load, radius, m->history->modulus),
           l = ehl_inlet_buildup(a, radius, h),
           begin = fmax(0, ceil(ehl_outlet_begins(m->solver->reynolds, a, l)));
    size_t n = m->solver->grid->nodes, outlet = (size_t)fmin(begin, (double)n);
    double crossing = fmin(time, OUTLET_LENGTH * l / fmax(m->trial_at.entrainment, 1e-300));
    return fmax(time * ehl_greatest_size(outlet, m->local),
                crossing * ehl_greatest_size(n - outlet, m->local + outlet));
}

/*
 * Returns the x from which errors accumulate: half a pressure build-up length upstream of the
 * contact. Further upstream the pressure flow determines the film anew. Without load the film keeps
 * its errors over the whole width of the contact.
 */
static double start_of_accumulation(const ehl_march *m)
{
    double load = m->trial_at.load, radius = m->trial_at.radius, h = m->trial.thinnest;
    if (!m->trial_step.loaded || !(load > 0 && h > 0))
        return -m->solver->grid->half_width;
    double a = ehl_hertz_half_width(load, radius, m->history->modulus);
    return -a - ehl_inlet_buildup(a, radius, h) / 2;
}

/* Updates the length of film that still comes from within a step in which the load jumped. Steps of
   second order do not resolve such a jump. */
static void detect_load_jump(ehl_march *m, double distance)
{
    const double leap = 1.2, passage = 3 * m->solver->grid->half_width;
    double before = m->at.load, now = m->trial_at.load;
    int jumped = !(now < leap * before && before < leap * now);
    m->distance_of_jump = jumped ? passage : fmax(m->distance_of_jump - distance, 0);
}

/*
 * Returns the error of a step at a breakpoint of the film. If the third difference is as large as
 * the second, half of the second difference is the error of every step after a breakpoint. For y' =
 * 0, then v, with equal steps, y is 0, 2/3, 14/9, 68/27 v dt at 0, 1, 2, 3, so the errors add up to
 * v dt/2. The errors from the third difference would cancel instead.
 */
static double error_at_kink(double local, double third, double second)
{
    return fabs(third) > fabs(second) / 2 && fabs(second) > 2 * fabs(local) ? second / 2 : local;
}

/* to = (1 - part) from + part times the value of the node before, plus gain/cells. */
FF_SIMD
static void fill_moved(size_t n, const double *restrict from, double part,
                       const double *restrict gain, double cells, double *restrict to)
{
    for (size_t i = 0; i < n; i++)
        to[i] = (1 - part) * from[i] + part * from[i - 1] + gain[i] / cells;
}

/* Fills in the sums of `local` up to each node. The sum along the path of the oil is the difference
   of the sums at both ends of the path. */
FF_SIMD
static void sum_on_way(size_t n, const double *restrict local, double cells, double *restrict sum,
                       double *restrict error)
{
    double met = 0;
    for (size_t i = 0; i < n; i++)
        sum[i] = met += local[i];
    for (size_t i = 0; i < n; i++)
        error[i] -= sum[i] / cells;
}

/* Moves the accumulated error with the film by `cells`, and adds the mean of `local` along that
   path, downstream of node `first`. Upstream of that node no error accumulates. */
static void advect_and_add(ehl_march *m, size_t first, double cells)
{
    size_t n = m->solver->grid->nodes, whole = (size_t)fmin(cells, (double)n), start = whole + 1;
    double *sum = m->accumulated_error, *moved = m->deflection, *gain = m->change;
    first = first < n ? first : n;
    /* errors from upstream of the first node are not known */
    start = start < first ? first : start < n ? start : n;
    if (cells > 1)
        sum_on_way(n - first, m->local + first, cells, gain + first, sum + first);
    else
        gain = m->local;
    memcpy(moved, m->local, first * sizeof *moved);
    for (size_t i = first; i < start; i++)
        moved[i] = gain[i] / fmax(cells, 1);
    fill_moved(n - start, sum + start - whole, cells - (double)whole, gain + start, fmax(cells, 1),
               moved + start);
    m->accumulated_error = moved;
    m->deflection = sum;
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
