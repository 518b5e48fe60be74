/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the errors of a film due to the cells, the time steps and the ends of the domain. */
#include "../contact/simd-reductions.h"
#include "../estimates/inlet.h"
#include "../time/error-transport.h"
#include "../time/truncation.h"
#include "results.h"

#include <math.h>
#include <string.h>

/* The contact of an instant, and the lengths that its film changes over. */
typedef struct contact {
    double a, p_hertz;
    double opening; /* sqrt(2 R h) */
    double buildup; /* m, pressure build-up length of the inlet, and of the fall at the outlet */
    double sliding; /* m/s */
} contact;

static contact contact_at(const ehl_instant *at, double modulus, double h)
{
    double radius = at->radius;
    double a = ehl_hertz_half_width(at->load, radius, modulus);
    return (contact){.a = a,
                     .p_hertz = ehl_hertz_pressure(at->load, radius, modulus),
                     .sliding = at->sliding,
                     .opening = sqrt(2 * radius * h),
                     .buildup = ehl_inlet_buildup(a, radius, h)};
}

/* Returns the largest accumulated truncation of the film near that node. */
static double accumulated_error_near(const ehl_march *m, size_t node)
{
    enum { NEAR = 4 };
    size_t n = m->solver->grid->nodes, from = node > NEAR ? node - NEAR : 0,
           end = node + NEAR < n ? node + NEAR + 1 : n;
    return ehl_greatest_size(end - from, m->accumulated_error + from);
}

/* lowered = h (1 - caution |error|) */
FF_SIMD
static void fill_lowered(size_t n, const double *restrict h, const double *restrict error,
                         double caution, double *restrict lowered)
{
    for (size_t i = 0; i < n; i++)
        lowered[i] = h[i] * (1 - caution * fabs(error[i]));
}

/* Returns by how much the least film may be lower due to the steps, relative to it: by its own
 * error, or because another dip is lower than that film without its error. */
static double least_in_time(ehl_results *r, const ehl_march *m, size_t node)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    double own = EHL_CAUTION * accumulated_error_near(m, node);
    fill_lowered(eq->nodes, eq->h, m->accumulated_error, EHL_CAUTION, r->tau);
    return fmax(own, 1 - ehl_least(eq->nodes, r->tau) / r->row[EHL_H_MIN]);
}

/*
 * Share of the load that is carried close to the end of the domain, within a quarter of
 * sqrt(2 R h); 0 where the film ruptures upstream of the end, which then has no effect.
 */
static double outlet_load(const ehl_march *m, double length)
{
    const ehl_grid *g = m->solver->grid;
    const ehl_film *film = &m->state[0].film;
    size_t last = g->nodes - 2, near = (size_t)(length / (4 * g->dx));
    double sum = 0;
    for (size_t i = last; film->full[last] && i > 0 && i + near >= last; i--)
        sum += film->p[i];
    return sum * g->dx / m->step.load;
}

/* Returns the share of the starvation that remains although the domain begins with the pressure
 * that a longer domain has there. */
static double unfed(const ehl_march *m, double h_central)
{
    const ehl_state *now = &m->state[0], *before = &m->state[1];
    const ehl_grid *g = m->solver->grid;
    size_t centre = (size_t)(g->inlet / g->dx);
    double dt = now->time - before->time, closing = 0, spreading = 0;
    if (m->known > 1 && m->step.past && dt > 0) {
        closing = (now->gap[centre] - before->gap[centre]) / dt;
        spreading = (now->gap[0] - before->gap[0]) / dt - closing;
    }
    return ehl_unfed(&m->solver->reynolds->oil, &m->at, m->history->modulus, h_central, g->inlet,
                     m->step.feed, closing, spreading);
}

/* How well the grid resolves the contact and its inlet. */
static void record_resolution(ehl_results *r, const ehl_march *m, double h_central,
                              const contact *c)
{
    const ehl_grid *g = m->solver->grid;
    r->least_resolution = fmin(r->least_resolution, c->buildup / g->dx);
    r->least_inlet = fmin(r->least_inlet, (g->inlet - c->a) / c->opening);
    double way = m->at.entrainment * (m->state[0].time - m->state[1].time);
    double share = m->known > 1 ? fmin(1, way / (2 * fmax(c->a, c->opening))) : 1;
    r->outlet_load += share * (outlet_load(m, c->opening) - r->outlet_load);
    r->worst_outlet = fmax(r->worst_outlet, r->outlet_load);
    const ehl_oil *oil = &m->solver->reynolds->oil;
    double missing = ehl_starvation(oil, &m->at, m->history->modulus, h_central, g->inlet);
    r->fed = g->fed;
    if (g->fed)
        missing *= unfed(m, h_central);
    r->starvation += share * (missing - r->starvation);
    r->worst_starvation = fmax(r->worst_starvation, r->starvation);
}

/* The oil where the outlet begins, at the Hertzian pressure a build-up length inside x = a. */
typedef struct outlet_oil {
    double pressure;
    double fluidity;    /* eta0/eta */
    double compression; /* d ln(rho)/d ln(p) */
} outlet_oil;

static outlet_oil oil_at_outlet(const ehl_reynolds *eq, const contact *c, double h, double p_max)
{
    double depth = fmin(1, c->buildup / c->a);
    double p = fmin(p_max, c->p_hertz * sqrt(depth * (2 - depth))), all[EHL_LIQUID_ARRAYS];
    const ehl_liquid q = {all, all + 1, all + 2, all + 3, all + 4, all + 5, all + 6, all + 7};
    ehl_fluid_evaluate(&eq->laws, 1, &p, &h, c->sliding, &q);
    return (outlet_oil){p, *q.psi * eq->oil.viscosity, p * *q.rho_p / *q.rho};
}

/*
 * Share of a spike that the cells cut off, with x = dx over the build-up length l:
 *   x/(x + w)/(1 + c/0.07 + 4 v^0.6),   w = v + 0.14 c,   v = 40 eta0/eta,   c = d ln(rho)/d ln(p).
 * Downstream of the spike the pressure falls over v l, since the pressure flow goes with 1/eta.
 * Upstream of it the oil is compressed as much as the flanks deflect over c l; without that the
 * spike of a thick oil would have no limit. The factors are fitted to steady solutions on 128 to
 * 131072 cells, M 2 to 200, L 2 to 15, of Roelands' and Barus' laws with and without compression;
 * volumes from node to node cut off as much with cells 1/0.3 times as large.
 */
static double spike_share_cut_off(const ehl_reynolds *eq, const outlet_oil *oil, double x)
{
    double v = 40 * oil->fluidity, w = v + 0.14 * oil->compression;
    if (eq->asymmetric && eq->wedge == 2)
        x *= 0.3;
    return x / (x + w) / (1 + oil->compression / 0.07 + 4 * pow(v, 0.6));
}

/* Whether p falls by more than `share` within two nodes of the maximum at node i. A tip that the
 * cells cut off is that steep; the crest of a squeezed film, which may wander to the outlet, is
 * not. */
static int is_steep(const double *p, size_t i, size_t last, double share)
{
    double lowest = fmin(p[i - 1], p[i + 1]);
    lowest = i > 1 ? fmin(lowest, p[i - 2]) : lowest;
    lowest = i + 2 <= last ? fmin(lowest, p[i + 2]) : lowest;
    return p[i] - lowest > share * p[i];
}

int ehl_space_order(const ehl_reynolds *eq)
{
    return eq->asymmetric && eq->conserving ? 1 : eq->wedge;
}

/* Returns the first node of the outlet. */
static size_t outlet_from(const ehl_reynolds *eq, const contact *c)
{
    return (size_t)fmax(1, ceil(ehl_outlet_begins(eq, c->a, c->buildup)));
}

/* Returns the highest pressure of the outlet's spike; 0: there is none. The spike is a maximum at
 * most 1.6 build-up lengths inside x = a, so steep that the cells may cut off the share `cut` of
 * it. If the build-up length exceeds 0.6 a the maximum is the spike itself, even upstream of x = 0.
 */
static double highest_spike(const ehl_reynolds *eq, const double *p, const contact *c, double cut)
{
    double highest = 0;
    size_t last = eq->nodes - 1;
    for (size_t i = outlet_from(eq, c); i < last; i++)
        if (p[i] > highest && p[i] >= p[i - 1] && p[i] > p[i + 1] && is_steep(p, i, last, cut))
            highest = p[i];
    return highest;
}

/* Estimates the relative error of a pressure without a spike. It is in proportion to (l/a)^2, since
 * a Hertzian pressure has hardly any, and grows with the square of ln(eta/eta0) at the outlet. */
static double smooth_pressure_error(const ehl_reynolds *eq, const contact *c, double fluidity)
{
    double x = eq->dx / c->buildup, part = fmin(1, c->buildup / c->a);
    double thick = fmin(5, -log(fmax(fluidity, 1e-9)));
    double error = eq->wedge == 2 ? ((eq->asymmetric ? 0.6 : 0.2) + 0.15 * thick * thick) * x * x
                                  : (0.35 + 0.05 * thick * thick) * x;
    return error * part * part;
}

/* Error of p_max due to the cells: how much the spike may exceed p_max. If the outlet has no
 * maximum, the hidden spike is taken as 0.9 of the pressure at the outlet, as the coarsest cells
 * show it.
 */
static ehl_spike spike_at(const ehl_reynolds *eq, const contact *c, const ehl_crest *of)
{
    const double caution = 1.2; /* the tip may lie between two nodes */
    outlet_oil oil = oil_at_outlet(eq, c, of->h_central, of->p_max);
    double cut = spike_share_cut_off(eq, &oil, eq->dx / c->buildup);
    double seen = highest_spike(eq, of->p, c, cut);
    double tip = fmax(seen, 0.9 * oil.pressure) * (1 + caution * cut / (1 - cut));
    double error = fmax(0, tip / of->p_max - 1) + smooth_pressure_error(eq, c, oil.fluidity);
    return (ehl_spike){seen, tip, cut, error};
}

ehl_spike ehl_spike_of(const ehl_reynolds *eq, const ehl_instant *at, double modulus,
                       const ehl_crest *of)
{
    contact c = contact_at(at, modulus, of->h_central);
    return spike_at(eq, &c, of);
}

/* Returns the speed v of the pressure in the outlet, from p_t + v p_x = 0 by least squares. In a
 * frame of that speed the pressure there changes least in time. */
static double speed_of_outlet(const ehl_march *m, const contact *c)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = m->state[0].film.p, *before = m->state[1].film.p;
    double dt = m->state[0].time - m->state[1].time, sum = 0, square = 0;
    for (size_t i = outlet_from(eq, c); i + 1 < eq->nodes; i++) {
        double slope = (p[i + 1] - p[i - 1] + before[i + 1] - before[i - 1]) / (4 * eq->dx);
        sum += (p[i] - before[i]) / dt * slope;
        square += slope * slope;
    }
    return square > 0 ? -sum / square : 0;
}

/* Computes the rate of change of the mass in a frame that moves by `frame`. The slope of the mass
 * is that of the wedge of volumes around full nodes, so that the choice of the frame makes no
 * difference to such a film on the same cells. */
FF_SIMD
static void change_in_frame(size_t n, const double *restrict mass, const double *restrict past,
                            double rate, double frame, double dx, int wedge,
                            double *restrict change)
{
    const double bend = wedge == 2 ? 0.5 : 0;
    change[0] = rate * mass[0] + past[0];
    change[1] = rate * mass[1] + past[1] + frame * (mass[1] - mass[0]) / dx;
    for (size_t i = 2; i < n; i++) {
        double slope = mass[i] - mass[i - 1];
        slope += bend * (slope - (mass[i - 1] - mass[i - 2]));
        change[i] = rate * mass[i] + past[i] + frame * slope / dx;
    }
}

void ehl_space_keep(const ehl_march *m, ehl_instant_film *f)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    f->h_central = ehl_central_film(m->solver->grid, eq);
    f->p_max = m->state[0].highest;
    f->at = m->at;
    f->cells = eq->nodes - 1;
    contact c = contact_at(&m->at, m->history->modulus, f->h_central);
    f->frame = m->step.past && m->known > 1 ? speed_of_outlet(m, &c) : 0;
    if (m->step.past)
        change_in_frame(eq->nodes, m->state[0].mass, m->step.past, m->step.rate, f->frame, eq->dx,
                        eq->wedge, f->change);
    else
        memset(f->change, 0, eq->nodes * sizeof *f->change);
}

/* Returns the largest relative change of the film, under at least half of the largest pressure,
 * while the oil moves by the half width a. From 1 on the film is squeezed more than it is carried
 * along. */
static double change_of_film(const ehl_march *m, const contact *c, const ehl_crest *of)
{
    const double *mass = m->state[0].mass, *before = m->state[1].mass;
    double way = fabs(m->at.entrainment) * (m->state[0].time - m->state[1].time), most = 0;
    for (size_t i = 0; i < m->solver->grid->nodes; i++)
        if (of->p[i] > of->p_max / 2)
            most = fmax(most, fabs(mass[i] - before[i]) / mass[i]);
    return way > 0 ? most * c->a / way : INFINITY;
}

/* How much the pressure may exceed p_max. */
typedef struct narrow_peak {
    double tip; /* Pa, above p_max */
    int climbs; /* 1: the peak climbs with each halving of the cells, and has no bound */
} narrow_peak;

/* Returns how much the pressure may exceed p_max if the film is far from a steady one; the other
 * bounds hold only for films that are nearly steady. A maximum above p_max/2 may be higher by half
 * of its fall within two nodes, which is about twice its fall within one cell. If the film is
 * squeezed, so that it changes by more than three times itself, a maximum upstream of the outlet
 * that falls by more than 4 % is not resolved: under a sudden load on Barus' oil it climbs with
 * each halving of the cells, and has no known limit. A spike of the outlet has a limit
 * (spike_share_cut_off). */
static narrow_peak narrow_peak_of(const ehl_march *m, const contact *c, const ehl_crest *of)
{
    const double steady = 0.3, squeezed = 3, broad = 0.04, *p = of->p;
    const double change = change_of_film(m, c, of);
    const size_t outlet = outlet_from(m->solver->reynolds, c);
    narrow_peak most = {0};
    for (size_t i = 2; i + 2 < m->solver->grid->nodes && change > steady; i++) {
        if (!(p[i] > of->p_max / 2 && p[i] >= p[i - 1] && p[i] > p[i + 1]))
            continue;
        double fall = p[i] - (p[i - 2] + p[i + 2]) / 2;
        most.tip = fmax(most.tip, p[i] + fall / 2 - of->p_max);
        most.climbs |= i < outlet && fall > broad * p[i] && change > squeezed;
    }
    return most;
}

double ehl_peak_bound(const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_state *now = &m->state[0];
    const ehl_crest of = {now->film.p, ehl_central_film(m->solver->grid, eq), now->highest};
    if (!ehl_march_is_loaded(m))
        return (double)INFINITY;
    const contact c = contact_at(&m->at, m->history->modulus, of.h_central);
    double bound = spike_at(eq, &c, &of).error * of.p_max;
    if (!(m->step.past && m->known > 1))
        return bound;
    const narrow_peak narrow = narrow_peak_of(m, &c, &of);
    return narrow.climbs ? (double)INFINITY : fmax(bound, narrow.tip);
}

/* The order of magnitude of the error due to the cells, which serves the tolerances of the solution
 * alone, over 1/n^p with n cells over the build-up length: that of h_min for M 16 and L 5 at n 15.
 */
static const double MAGNITUDE = 0.35;

/* Records what is known of the cells alone. The errors of h_min and h_central are not known until
 * they are found. */
static void record_bounds(ehl_results *r, const ehl_march *m, double h_central, double p_max,
                          const contact *c)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_crest of = {m->state[0].film.p, h_central, p_max};
    r->by_cells = MAGNITUDE * pow(eq->dx / c->buildup, eq->wedge);
    ehl_worse(&r->worst_by_cells, r->by_cells);
    r->row_in_space[EHL_LEAST] = r->row_in_space[EHL_CENTRAL] = (double)INFINITY;
    r->row_in_space[EHL_PEAK] = spike_at(eq, c, &of).error * p_max;
    if (r->peaks && !m->rough && m->step.past && m->known > 1) {
        const narrow_peak narrow = narrow_peak_of(m, c, &of);
        r->row_in_space[EHL_TIP] = narrow.tip;
        r->row_in_space[EHL_NARROW] = narrow.climbs ? (double)INFINITY : 0;
    }
}

/* Returns what the parabola through the lowest node i leaves out of h_min, m. At the distance t
 * from that node, in cells, the cubic through one more node on that side differs from the parabola
 * by t (t^2 - 1)/6 of the third difference. */
static double left_by_parabola(const ehl_march *m, size_t i)
{
    const double *h = m->solver->reynolds->h;
    if (m->rough || i < 2 || i + 2 >= m->solver->reynolds->nodes)
        return 0;
    double bend = h[i + 1] - 2 * h[i] + h[i - 1], t = (h[i - 1] - h[i + 1]) / (2 * bend);
    double third = t < 0 ? h[i + 1] - 3 * h[i] + 3 * h[i - 1] - h[i - 2]
                         : h[i + 2] - 3 * h[i + 1] + 3 * h[i] - h[i - 1];
    return bend > 0 ? fabs(t * (t * t - 1) / 6 * third) : 0;
}

/* Records the errors due to the cells from their transport, which may have failed. */
static void put_transported(ehl_results *r, const ehl_march *m)
{
    const double film[] = {r->row[EHL_H_MIN], r->row[EHL_H_CENTRAL]};
    double error[] = {INFINITY, INFINITY};
    if (m->transport->known)
        ehl_results_transported(r, m, error);
    for (int k = EHL_LEAST; k <= EHL_CENTRAL; k++)
        r->row_in_space[k] = ehl_known_error(error[k]) * film[k];
}

static void keep_least(double *least, double value)
{
    if (!(value >= *least))
        *least = isfinite(value) ? value : -1e300;
}

void ehl_results_errors(ehl_results *r, const ehl_march *m, size_t node, double h_central,
                        double p_max)
{
    const ehl_grid *g = m->solver->grid;
    size_t centre = (size_t)(g->inlet / g->dx + 0.5);
    double time[] = {least_in_time(r, m, node), EHL_CAUTION * accumulated_error_near(m, centre)};
    if (ehl_march_is_loaded(m)) {
        contact c = contact_at(&m->at, m->history->modulus, h_central);
        record_resolution(r, m, h_central, &c);
        record_bounds(r, m, h_central, p_max, &c);
        for (int k = EHL_LEAST; k <= EHL_CENTRAL; k++)
            ehl_worse(&r->worst_in_time[k], time[k]);
        keep_least(&r->least_in_time, r->row[EHL_H_MIN] * (1 - time[EHL_LEAST]));
    } else if (r->lowest_alone) { /* the lowest film may be one without load */
        r->row_in_space[EHL_LEAST] = (double)INFINITY;
    }
    if (m->transport && (ehl_march_is_loaded(m) || r->lowest_alone))
        put_transported(r, m);
    r->row_in_space[EHL_PARTED] = !(ehl_history_at(m->history, m->at.time).load > 0);
    r->row[EHL_H_MIN_ERROR] = time[EHL_LEAST] * r->row[EHL_H_MIN] + left_by_parabola(m, node);
    r->row[EHL_H_CENTRAL_ERROR] = time[EHL_CENTRAL] * r->row[EHL_H_CENTRAL];
}
