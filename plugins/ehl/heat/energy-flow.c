/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the flow across a film with given temperatures. */
#include "energy.h"

#include "../../numerics/answers.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* FIELDS: number of arrays with a value for each node and each point across the film. OWN: number
   of arrays with one value per node. */
enum { FIELDS = 19, OWN = 10 };

/* Returns the number of values in e->memory. */
static size_t room_of(size_t nodes, size_t across)
{
    return (FIELDS + 3 + across) * nodes * across + (OWN + 2) * nodes + EHL_LANES;
}

ff_status ehl_energy_create(ehl_energy *e, size_t nodes, size_t across)
{
    size_t n = nodes, all = nodes * across;
    *e = (ehl_energy){.nodes = nodes, .share = 1, .damping = 1, .highest = 2000, .lowest = 150};
    ehl_across_create(&e->across, across);
    double *next = e->memory = calloc(room_of(nodes, across), sizeof *next);
    if (!next)
        return FF_NOMEM;
    double **field[FIELDS] = {&e->p,          &e->ln_eta,    &e->rho,       &e->tau,
                              &e->gamma,      &e->gamma_tau, &e->gamma_eta, &e->u,
                              &e->through,    &e->called_p,  &e->called_T,  &e->ln_eta_p,
                              &e->ln_eta_T,   &e->rho_p,     &e->rho_T,     &e->called_ln_eta,
                              &e->called_rho, &e->bend,      &e->before};
    for (size_t k = 0; k < FIELDS; k++, next += all)
        *field[k] = next;
    double **own[OWN] = {&e->tau_m,   &e->p_x,     &e->mobility, &e->mass,    &e->carried,
                         &e->flux[0], &e->flux[1], &e->base[0],  &e->base[1], &e->excess};
    e->inverted = next;
    e->inverse = next + 3 * all;
    next += (3 + across) * all;
    for (size_t k = 0; k < OWN; k++, next += n)
        *own[k] = next;
    e->reverse = (unsigned char *)next;
    e->there = e->reverse + n;
    e->column = calloc(n, sizeof *e->column);
    return e->column ? FF_OK : FF_NOMEM;
}

void ehl_energy_destroy(ehl_energy *e)
{
    free(e->memory);
    free(e->column);
    e->memory = NULL;
    e->column = NULL;
}

void ehl_energy_restart(ehl_energy *e)
{
    e->guessed = 0;
    memset(e->memory, 0, room_of(e->nodes, e->across.count) * sizeof *e->memory);
}

static void note(ehl_energy *e, ff_status status)
{
    e->law_status = numerics_worse(e->law_status, status);
}

/* Sets the curvature of n values with respect to their first-order change, from two evaluations of
   the laws. The earlier evaluation gave `from` and slopes, which predict `line` for the arguments
   at which the new evaluation gives `given`. If the first-order change is below `least`, as at the
   first evaluation, it contains too little information, and the curvature is kept. The curvature is
   limited to `most`: up to a change of 1/most, the parabola then adds at most half of the
   first-order change. */
FF_SIMD
static void bend_by(size_t n, const double *restrict from, const double *restrict line,
                    const double *restrict given, double least, double most, double *restrict bend)
{
    for (size_t j = 0; j < n; j++) {
        double way = line[j] - from[j], is = 2 * (given[j] - line[j]) / (way * way);
        is = is < most ? is : most;
        is = is > -most ? is : -most;
        bend[j] = fabs(way) > least ? is : bend[j];
    }
}

/* Extrapolates n values linearly in p and T from the last evaluation of the laws. */
FF_SIMD
static void follow(size_t n, const double *restrict p, const double *restrict T,
                   const double *restrict from_p, const double *restrict from_T,
                   const double *restrict given, const double *restrict by_p,
                   const double *restrict by_T, double *restrict value)
{
    for (size_t j = 0; j < n; j++)
        value[j] = given[j] + (by_p[j] * (p[j] - from_p[j]) + by_T[j] * (T[j] - from_T[j]));
}

/* Extrapolates from the last evaluation along a parabola with the curvature `bend`. */
FF_SIMD
static void follow_bent(size_t n, const double *restrict p, const double *restrict T,
                        const double *restrict from_p, const double *restrict from_T,
                        const double *restrict given, const double *restrict by_p,
                        const double *restrict by_T, const double *restrict bend,
                        double *restrict value)
{
    for (size_t j = 0; j < n; j++) {
        double way = by_p[j] * (p[j] - from_p[j]) + by_T[j] * (T[j] - from_T[j]);
        value[j] = given[j] + way * (1 + 0.5 * bend[j] * way);
    }
}

/* Evaluates the laws at the nodes `from` to `end`. e->ln_eta contains the values extrapolated from
   the previous evaluation. */
static void call_laws_at(ehl_energy *e, size_t from, size_t end, const double *T)
{
    const ff_viscosity *v = e->laws.viscosity;
    const ff_density *d = e->laws.density;
    size_t n = e->across.count, at = from * n, count = (end - from) * n;
    const double *p = e->p + at, least = e->reach / 4;
    double *line = e->ln_eta + at, *given = e->tau + at;
    note(e, v->eval(v->self, count, p, T + at, given, e->ln_eta_p + at, e->ln_eta_T + at));
    bend_by(count, e->called_ln_eta + at, line, given, least, 1 / e->reach, e->bend + at);
    memcpy(e->called_ln_eta + at, given, count * sizeof *given);
    note(e, d->eval(d->self, count, p, T + at, e->called_rho + at, e->rho_p + at, e->rho_T + at));
    memcpy(e->called_p + at, p, count * sizeof *p);
    memcpy(e->called_T + at, T + at, count * sizeof *T);
}

/* Copies the value of each of `nodes` nodes to all n points across the film. */
FF_SIMD_INLINE void spread_to(size_t nodes, size_t n, const double *restrict values,
                              double *restrict to)
{
    for (size_t i = 0; i < nodes; i++)
        for (size_t k = 0; k < n; k++)
            to[i * n + k] = values[i];
}

/* Marks the nodes at which ln(eta), extrapolated linearly, has changed by more than `reach`. A
   parabola is not suitable for this test, since it may return to its start. */
FF_SIMD_INLINE void mark_beyond(size_t nodes, size_t n, const double *restrict now,
                                const double *restrict called, double reach,
                                unsigned char *restrict mark)
{
    for (size_t i = 0; i < nodes; i++) {
        int64_t beyond = 0;
        for (size_t k = 0; k < n; k++)
            beyond |= !(fabs(now[i * n + k] - called[i * n + k]) <= reach);
        mark[i] = beyond != 0;
    }
}

/* spread and find_beyond pass the preset number of nodes across as a compile-time constant. */
FF_SIMD
static void spread(size_t nodes, size_t across, const double *values, double *to)
{
    if (across == EHL_ACROSS_PRESET)
        spread_to(nodes, EHL_ACROSS_PRESET, values, to);
    else
        spread_to(nodes, across, values, to);
}

FF_SIMD
static void find_beyond(ehl_energy *e, size_t nodes)
{
    size_t n = e->across.count;
    if (n == EHL_ACROSS_PRESET)
        mark_beyond(nodes, EHL_ACROSS_PRESET, e->ln_eta, e->called_ln_eta, e->reach, e->there);
    else
        mark_beyond(nodes, n, e->ln_eta, e->called_ln_eta, e->reach, e->there);
}

/* Returns whether the laws must be evaluated at node i: if the film is steady, if ln(eta) has
   changed by more than e->reach, or if the laws were not evaluated at the node before. */
static int is_due(const ehl_energy *e, const ehl_energy_film *film, size_t i)
{
    return !(film->rate > 0) || e->there[i] || !(e->called_T[i * e->across.count] > 0);
}

/* Sets viscosity and density at all points. Where ln(eta) has changed by less than e->reach since
   the last evaluation of the laws, viscosity and density are extrapolated from that evaluation: the
   density linearly, ln(eta) along a parabola. */
static void call_laws(ehl_energy *e, const ehl_energy_film *film, const double *T)
{
    size_t across = e->across.count, all = film->count * across;
    double *before = e->ln_eta;
    e->ln_eta = e->before;
    e->before = before;
    spread(film->count, across, film->p, e->p);
    follow(all, e->p, T, e->called_p, e->called_T, e->called_ln_eta, e->ln_eta_p, e->ln_eta_T,
           e->ln_eta);
    find_beyond(e, film->count);
    for (size_t i = 0, end; i < film->count; i = end) {
        for (end = i; end < film->count && is_due(e, film, end); end++)
            ;
        if (end > i)
            call_laws_at(e, i, end, T);
        else
            end++;
    }
    follow_bent(all, e->p, T, e->called_p, e->called_T, e->called_ln_eta, e->ln_eta_p, e->ln_eta_T,
                e->bend, e->ln_eta);
    follow(all, e->p, T, e->called_p, e->called_T, e->called_rho, e->rho_p, e->rho_T, e->rho);
}

/* Computes the shear rates at tau_m, and their derivatives, at the nodes `from` to `end`. */
static void call_flow(ehl_energy *e, size_t from, size_t end, const double *T)
{
    size_t n = e->across.count, at = from * n, count = (end - from) * n;
    spread(end - from, n, e->tau_m + from, e->tau + at);
    if (e->flow) {
        note(e, e->flow->rate(e->flow->self, count, e->p + at, T + at, e->ln_eta + at, e->tau + at,
                              e->gamma + at, e->gamma_tau + at, e->gamma_eta + at));
        return;
    }
    for (size_t j = at; j < at + count; j++) {
        e->gamma_tau[j] = exp(-e->ln_eta[j]);
        e->gamma[j] = e->tau[j] * e->gamma_tau[j];
        e->gamma_eta[j] = -e->gamma[j];
    }
}

/* Means across the film of three quantities: the shear rate, its derivative with respect to stress,
   and this derivative times (z - h/2)/h. */
typedef struct means {
    double gamma, slope, tilt;
} means;

FF_SIMD_INLINE means means_of(const ehl_energy *e, size_t i, size_t n)
{
    const ehl_across *a = &e->across;
    const double *gamma = e->gamma + i * n, *slope = e->gamma_tau + i * n;
    ehl_lanes rate = {0}, ease = {0}, tilt = {0}, weight, z, here;
    for (size_t k = 0; k < n; k += EHL_LANES) { /* the weights from n on are 0 */
        memcpy(&weight, a->weight + k, sizeof weight);
        memcpy(&z, a->z + k, sizeof z);
        memcpy(&here, gamma + k, sizeof here);
        rate += weight * here;
        memcpy(&here, slope + k, sizeof here);
        ease += weight * here;
        tilt += weight * here * (z - 0.5);
    }
    return (means){ehl_lanes_sum(&rate), ehl_lanes_sum(&ease), ehl_lanes_sum(&tilt)};
}

/* Returns the Newton step of tau_m towards the mean shear rate `target`. Newton's method is applied
   to asinh of the rate, since rates grow exponentially with the stress. */
static double stress_step(means m, double target, double scale)
{
    const double close = 0.1;
    if (!(m.slope > 1e-290))
        return 0;
    if (fabs(m.gamma - target) <= close * fabs(target))
        return (target - m.gamma) / m.slope;
    double unit = fmax(fabs(target), scale);
    return (asinh(target / unit) - asinh(m.gamma / unit)) * hypot(unit, m.gamma) / m.slope;
}

/* Sets tau_m to the stress of a film that has the viscosity of its middle everywhere. */
static void guess_stress(ehl_energy *e, const ehl_energy_film *film)
{
    const ff_rheology_3 *law = e->laws.rheology;
    size_t n = film->count, across = e->across.count;
    double slip = film->speed[1] - film->speed[0], *ln_eta = e->mass;
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = e->ln_eta[i * across + across / 2];
        e->tau_m[i] = exp(fmin(ln_eta[i], 230)) * slip / film->h[i];
    }
    if (law && e->flow)
        note(e, law->shear(law->self, n, film->p, NULL, ln_eta, film->h, slip, e->tau_m));
    e->guessed = 1;
}

/* Corrects the stress at node i by a Newton step, so that the film is sheared at the difference of
   the flanks' speeds. Returns 1 if the stress was already within `enough` of the solution, or if
   there is no solution. */
FF_SIMD_INLINE int take_stress(ehl_energy *e, const ehl_energy_film *film, double enough, size_t i,
                               size_t n)
{
    const double tiny = 1e-6;
    double per_h = 1 / film->h[i], target = (film->speed[1] - film->speed[0]) * per_h;
    double all = film->speed[1] + film->speed[0] + 2 * film->frame;
    double scale = tiny * all * per_h, size = fabs(target);
    means m = means_of(e, i, n);
    if (fabs(m.gamma - target) <= enough * (size > scale ? size : scale) || !(m.slope > 1e-290))
        return 1;
    double step = stress_step(m, target, scale), most = 0.9 * fabs(e->tau_m[i]);
    e->tau_m[i] +=
        fabs(step) > most && most > 0 && step * e->tau_m[i] < 0 ? copysign(most, step) : step;
    return 0;
}

/* Predicts the stress at node i from the changes of ln(eta), gap and speeds since the last flow,
   with the derivatives of that flow. A prediction that changes the stress by more than half of its
   value is not used. */
FF_SIMD_INLINE void expect_stress(ehl_energy *e, const ehl_energy_film *film, size_t i, size_t n)
{
    const double *now = e->ln_eta + i * n, *before = e->before + i * n,
                 *by_eta = e->gamma_eta + i * n;
    const double target = (film->speed[1] - film->speed[0]) / film->h[i],
                 *weight = e->across.weight;
    ehl_lanes rate = {0}, w, was, is, slope;
    means m = means_of(e, i, n);
    for (size_t k = 0; k < n; k += EHL_LANES) {
        memcpy(&w, weight + k, sizeof w);
        memcpy(&was, before + k, sizeof was);
        memcpy(&is, now + k, sizeof is);
        memcpy(&slope, by_eta + k, sizeof slope);
        rate += w * slope * (is - was);
    }
    double step = m.slope > 1e-290 ? (target - m.gamma - ehl_lanes_sum(&rate)) / m.slope : 0;
    if (fabs(step) <= 0.5 * fabs(e->tau_m[i]))
        e->tau_m[i] += step;
}

FF_SIMD
static int take_stress_at(ehl_energy *e, const ehl_energy_film *film, double enough, size_t i)
{
    return e->across.count == EHL_ACROSS_PRESET ? take_stress(e, film, enough, i, EHL_ACROSS_PRESET)
                                                : take_stress(e, film, enough, i, e->across.count);
}

FF_SIMD
static void expect_stress_at(ehl_energy *e, const ehl_energy_film *film, size_t i)
{
    if (e->across.count == EHL_ACROSS_PRESET)
        expect_stress(e, film, i, EHL_ACROSS_PRESET);
    else
        expect_stress(e, film, i, e->across.count);
}

/* Finds the stress of all columns. Columns that have converged are skipped. */
static void find_stress(ehl_energy *e, const ehl_energy_film *film, const double *T)
{
    enum { MOST = 30 };
    /* flow_across corrects the remaining error to first order and leaves half of its square: a
       hundredth of the error that e->reach allows */
    const double enough = film->rate > 0 ? e->reach / 10 : 1e-3;
    size_t left = film->count;
    memset(e->there, 0, left);
    for (int turn = 0; turn < MOST && left > 0; turn++) {
        left = 0;
        for (size_t i = 0, end; i < film->count; i = end + 1) {
            for (end = i; end < film->count && !e->there[end]; end++)
                ;
            if (end > i)
                call_flow(e, i, end, T);
            for (; i < end; i++)
                left += !(e->there[i] = (unsigned char)take_stress_at(e, film, enough, i));
        }
    }
}

/* Sets the part of each tau_m beyond the limiting stress, which is the stress that the law gives
   for a nearly solid liquid. If the Eyring stress is auto, the shear rates of rheology/2 have no
   limit; the limiting stress then affects the traction and its heat, but not the flow. */
static void find_excess(ehl_energy *e, const ehl_energy_film *film, const double *T)
{
    const ff_rheology_3 *law = e->laws.rheology;
    const double nearly_solid = 230; /* ln(eta/1 Pa s) */
    size_t n = film->count, across = e->across.count;
    double *ln_eta = e->mass, *middle = e->carried, *limit = e->excess;
    if (!law || !e->flow)
        return;
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = nearly_solid;
        middle[i] = T[i * across + across / 2];
    }
    ff_status status = law->shear(law->self, n, film->p, middle, ln_eta, film->h, 1, limit);
    note(e, status == FF_DOMAIN ? FF_OK : status);
    for (size_t i = 0; i < n; i++) {
        double beyond = fabs(e->tau_m[i]) - limit[i];
        e->excess[i] = beyond > 0 ? copysign(beyond, e->tau_m[i]) : 0;
    }
}

/* Returns int u rho dz over h with u(0) = u_1, from the shear rates in `gamma`. */
FF_SIMD_INLINE double flow_of(const ehl_across *a, size_t n, const double *rho, double u_1,
                              double h, const double *gamma, double *u)
{
    double rise[EHL_ACROSS_MOST];
    ehl_lanes sum = {0}, weight, here, dense;
    ehl_across_apply(a->integral[0], EHL_ACROSS_MOST, n, gamma, rise);
    for (size_t k = 0; k < n; k += EHL_LANES) {
        memcpy(&weight, a->weight + k, sizeof weight);
        memcpy(&dense, rho + k, sizeof dense);
        memcpy(&here, rise + k, sizeof here);
        sum += weight * dense * (u_1 + h * here);
    }
    FF_SIMD_LOOP
    for (size_t k = 0; k < n; k++)
        u[k] = u_1 + h * rise[k];
    return ehl_lanes_sum(&sum);
}

/* Returns the pressure gradient at node i by finite differences. */
static double gradient(const ehl_energy_film *film, size_t i)
{
    size_t before = i > 0 ? i - 1 : 0, next = i + 1 < film->count ? i + 1 : i;
    return (film->p[next] - film->p[before]) / ((double)(next - before) * film->dx);
}

/* Returns the change of the pressure gradient that gives the known mass flow. In a thick inlet two
   large flows nearly cancel, and a change of the viscosity alone would cause a spurious flow. If
   the flow hardly depends on the gradient, the gradient is not changed. */
static double correction(const ehl_energy_film *film, double flow, double mobility, double p_x,
                         double carried, size_t i)
{
    const double part = 0.3;
    if (!film->through || !film->full[i] || ehl_energy_touches(film, i))
        return 0;
    double driven = mobility * p_x, other = part * carried;
    double trust = driven * driven / (driven * driven + other * other + 1e-300);
    return mobility > 0 ? trust * (flow - film->through[i]) / mobility : 0;
}

/* Computes velocities, mass flows and the coefficients for Reynolds' equation at node i, with n
   nodes across. */
FF_SIMD_INLINE void flow_across(ehl_energy *e, const ehl_energy_film *film, size_t i, size_t n)
{
    const ehl_across *a = &e->across;
    size_t at = i * n;
    double h = film->h[i], slip = film->speed[1] - film->speed[0], p_x = e->p_x[i];
    double mean = (film->speed[0] + film->speed[1]) / 2 + film->frame, per_p_x[EHL_ACROSS_MOST],
           driven[EHL_ACROSS_MOST];
    double *tau = e->tau + at, *gamma = e->gamma + at, *slope = e->gamma_tau + at, *u = e->u + at;
    const double *rho = e->rho + at;
    means m = means_of(e, i, n);
    int flows = m.slope > 1e-290;
    double tilt = flows ? m.tilt / m.slope : 0;
    double left = flows ? (slip / h - m.gamma) / m.slope : 0;
    double *gamma_eta = e->gamma_eta + at;
    FF_SIMD_LOOP
    for (size_t k = 0; k < n; k++) {
        double more = left + (a->z[k] - 0.5 - tilt) * h * p_x;
        tau[k] += more - e->excess[i];
        gamma[k] = flows ? gamma[k] + more * slope[k] : slip / h;
        gamma_eta[k] -= more * slope[k];
        per_p_x[k] = h * slope[k] * (a->z[k] - 0.5 - tilt);
    }
    e->tau_m[i] += left;
    e->mobility[i] = flows ? -h * flow_of(a, n, rho, 0, h, per_p_x, driven) : 0;
    double flow = h * flow_of(a, n, rho, film->speed[0], h, gamma, u), density = 0;
    for (size_t k = 0; k < n; k++)
        density += a->weight[k] * rho[k];
    e->mass[i] = density * h;
    e->carried[i] = (flow + e->mobility[i] * p_x + film->frame * e->mass[i]) / mean;
    double more = correction(film, flow, e->mobility[i], p_x, fabs(mean) * e->mass[i], i);
    if (fabs(more) > 0) {
        FF_SIMD_LOOP
        for (size_t k = 0; k < n; k++) {
            tau[k] += h * (a->z[k] - 0.5 - tilt) * more;
            gamma[k] += per_p_x[k] * more;
            u[k] += driven[k] * more;
        }
    }
    e->p_x[i] += more;
    double *through = e->through + at;
    int64_t reverse = 0;
    FF_SIMD_LOOP
    for (size_t k = 0; k < n; k++) {
        through[k] = rho[k] * u[k] * h;
        reverse |= u[k] < 0;
    }
    e->reverse[i] = reverse != 0;
}

/* Passes the preset number of nodes across as a compile-time constant. */
FF_SIMD
static void flow_at(ehl_energy *e, const ehl_energy_film *film, size_t i)
{
    if (e->across.count == EHL_ACROSS_PRESET)
        flow_across(e, film, i, EHL_ACROSS_PRESET);
    else
        flow_across(e, film, i, e->across.count);
}

void ehl_energy_flow(ehl_energy *e, const ehl_energy_film *film, const double *T)
{
    call_laws(e, film, T);
    for (size_t i = 0; i < film->count; i++)
        e->p_x[i] = ehl_energy_touches(film, i) ? 0 : gradient(film, i);
    if (!e->guessed)
        guess_stress(e, film);
    else if (film->rate > 0)
        for (size_t i = 0; i < film->count; i++)
            expect_stress_at(e, film, i);
    find_stress(e, film, T);
    find_excess(e, film, T);
    for (size_t i = 0; i < film->count; i++)
        flow_at(e, film, i);
}
