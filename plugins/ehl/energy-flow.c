/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The flow across a film of given temperatures. */
#include "energy.h"

#include "../numerics/answers.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

ff_status ehl_energy_create(ehl_energy *e, size_t nodes, size_t across)
{
    enum { FIELDS = 17, OWN = 7 };
    size_t n = nodes, all = nodes * across;
    *e = (ehl_energy){.nodes = nodes, .highest = 2000, .lowest = 150};
    ehl_across_create(&e->across, across);
    double *next = e->memory = calloc(FIELDS * all + OWN * n + n, sizeof *next);
    if (!next)
        return FF_NOMEM;
    double **field[FIELDS] = {
        &e->p,        &e->ln_eta, &e->rho,     &e->tau,           &e->gamma,     &e->gamma_tau,
        &e->gamma_T,  &e->u,      &e->through, &e->called_p,      &e->called_T,  &e->ln_eta_p,
        &e->ln_eta_T, &e->rho_p,  &e->rho_T,   &e->called_ln_eta, &e->called_rho};
    for (size_t k = 0; k < FIELDS; k++, next += all)
        *field[k] = next;
    double **own[OWN] = {&e->tau_m,   &e->p_x,     &e->mobility, &e->mass,
                         &e->carried, &e->flux[0], &e->flux[1]};
    for (size_t k = 0; k < OWN; k++, next += n)
        *own[k] = next;
    e->reverse = (unsigned char *)next;
    return FF_OK;
}

void ehl_energy_destroy(ehl_energy *e)
{
    free(e->memory);
    e->memory = NULL;
}

static void note(ehl_energy *e, ff_status status)
{
    e->law_status = numerics_worse(e->law_status, status);
}

/* Calls the laws at the nodes `from` to `end`. */
static void call_laws_at(ehl_energy *e, size_t from, size_t end, const double *T)
{
    const ff_viscosity *v = e->laws.viscosity;
    const ff_density *d = e->laws.density;
    size_t n = e->across.count, at = from * n, count = (end - from) * n;
    const double *p = e->p + at;
    note(e, v->eval(v->self, count, p, T + at, e->called_ln_eta + at, e->ln_eta_p + at,
                    e->ln_eta_T + at));
    note(e, d->eval(d->self, count, p, T + at, e->called_rho + at, e->rho_p + at, e->rho_T + at));
    memcpy(e->called_p + at, p, count * sizeof *p);
    memcpy(e->called_T + at, T + at, count * sizeof *T);
}

/* Follows n values by their slopes from where they were given. */
FF_SIMD
static void follow(size_t n, const double *restrict p, const double *restrict T,
                   const double *restrict from_p, const double *restrict from_T,
                   const double *restrict given, const double *restrict by_p,
                   const double *restrict by_T, double *restrict value)
{
    for (size_t j = 0; j < n; j++)
        value[j] = given[j] + (by_p[j] * (p[j] - from_p[j]) + by_T[j] * (T[j] - from_T[j]));
}

/* Whether ln(eta) has changed by more than the reach at node i, or has not been called there. */
static int is_beyond(const ehl_energy *e, size_t i)
{
    size_t n = e->across.count, from = i * n;
    int within = e->called_T[from] > 0;
    for (size_t j = from; j < from + n; j++)
        within &= fabs(e->ln_eta[j] - e->called_ln_eta[j]) <= e->reach;
    return !within;
}

/* Viscosity and density at all places: by their slopes where these reach, whose error is less than
   half the square of the reach. */
static void call_laws(ehl_energy *e, const ehl_energy_film *film, const double *T)
{
    size_t across = e->across.count, all = film->count * across;
    for (size_t i = 0; i < film->count; i++)
        for (size_t k = 0; k < across; k++)
            e->p[i * across + k] = film->p[i];
    follow(all, e->p, T, e->called_p, e->called_T, e->called_ln_eta, e->ln_eta_p, e->ln_eta_T,
           e->ln_eta);
    for (size_t i = 0, end; i < film->count; i = end) {
        for (end = i; end < film->count && (!(film->rate > 0) || is_beyond(e, end)); end++)
            ;
        if (end > i)
            call_laws_at(e, i, end, T);
        else
            end++;
    }
    follow(all, e->p, T, e->called_p, e->called_T, e->called_ln_eta, e->ln_eta_p, e->ln_eta_T,
           e->ln_eta);
    follow(all, e->p, T, e->called_p, e->called_T, e->called_rho, e->rho_p, e->rho_T, e->rho);
}

/* Shear rates of e->tau with their slopes, by T at constant stress. */
static void call_flow(ehl_energy *e, size_t count, const double *T)
{
    size_t all = count * e->across.count;
    if (e->flow) {
        note(e, e->flow->rate(e->flow->self, all, e->p, T, e->ln_eta, e->tau, e->gamma,
                              e->gamma_tau, e->gamma_T));
        return;
    }
    for (size_t j = 0; j < all; j++) {
        e->gamma_tau[j] = exp(-e->ln_eta[j]);
        e->gamma[j] = e->tau[j] * e->gamma_tau[j];
        e->gamma_T[j] = -e->gamma[j];
    }
}

static void set_stress(ehl_energy *e, const ehl_energy_film *film)
{
    size_t n = e->across.count;
    for (size_t i = 0; i < film->count; i++)
        for (size_t k = 0; k < n; k++)
            e->tau[i * n + k] = e->tau_m[i];
}

/* Means across the film: of the shear rate, and of its slope times 1 and z - h/2 over h. */
typedef struct means {
    double gamma, slope, tilt;
} means;

static means means_of(const ehl_energy *e, size_t i)
{
    const ehl_across *a = &e->across;
    const double *gamma = e->gamma + i * a->count, *slope = e->gamma_tau + i * a->count;
    means m = {0, 0, 0};
    for (size_t k = 0; k < a->count; k++) {
        double here = a->weight[k] * slope[k];
        m.gamma += a->weight[k] * gamma[k];
        m.slope += here;
        m.tilt += here * (a->z[k] - 0.5);
    }
    return m;
}

/* Returns the step of tau_m towards the mean shear rate `target`, of Newton's method in the
   inverse hyperbolic sine of the rate: rates grow exponentially with the stress. */
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

/* Sets tau_m to the stress of a film with the viscosity at its middle. */
static void guess_stress(ehl_energy *e, const ehl_energy_film *film)
{
    const ff_rheology *law = e->laws.rheology;
    size_t n = film->count, across = e->across.count;
    double slip = film->speed[1] - film->speed[0], *ln_eta = e->mass;
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = e->ln_eta[i * across + across / 2];
        e->tau_m[i] = exp(fmin(ln_eta[i], 230)) * slip / film->h[i];
    }
    if (law && e->flow)
        note(e, law->shear(law->self, n, film->p, ln_eta, film->h, slip, e->tau_m));
    e->guessed = 1;
}

/* Takes the stress to that which shears the film by the speeds of the flanks. */
static void find_stress(ehl_energy *e, const ehl_energy_film *film, const double *T)
{
    enum { MOST = 30 };
    /* what is left is taken off by the slope: its square */
    const double enough = film->rate > 0 ? e->reach / 2 : 1e-3, tiny = 1e-6;
    double slip = film->speed[1] - film->speed[0], all = film->speed[1] + film->speed[0];
    for (int turn = 0; turn < MOST; turn++) {
        int done = 1;
        set_stress(e, film);
        call_flow(e, film->count, T);
        for (size_t i = 0; i < film->count; i++) {
            double target = slip / film->h[i], scale = tiny * all / film->h[i];
            means m = means_of(e, i);
            if (fabs(m.gamma - target) <= enough * fmax(fabs(target), scale) || !(m.slope > 1e-290))
                continue;
            double step = stress_step(m, target, scale), most = 0.9 * fabs(e->tau_m[i]);
            e->tau_m[i] += fabs(step) > most && most > 0 && step * e->tau_m[i] < 0
                               ? copysign(most, step)
                               : step;
            done = 0;
        }
        if (done)
            return;
    }
}

/* Returns int u rho dz with u(0) = u_1, of the rates in `gamma`, over h. */
FF_SIMD_INLINE double flow_of(const ehl_across *a, size_t n, const double *rho, double u_1,
                              double h, const double *gamma, double *u)
{
    double rise[EHL_ACROSS_MOST] = {0}, sum = 0;
    for (size_t l = 0; l < n; l++)
        for (size_t k = 0; k < n; k++)
            rise[k] += a->integral[l][k] * gamma[l];
    for (size_t k = 0; k < n; k++) {
        u[k] = u_1 + h * rise[k];
        sum += a->weight[k] * rho[k] * u[k];
    }
    return sum;
}

/* Returns the pressure gradient at node i by differences. */
static double gradient(const ehl_energy_film *film, size_t i)
{
    size_t before = i > 0 ? i - 1 : 0, next = i + 1 < film->count ? i + 1 : i;
    return (film->p[next] - film->p[before]) / ((double)(next - before) * film->dx);
}

/*
 * Returns how far the gradient must be changed for the film to pass the mass that it is known to
 * pass. In a thick inlet two large flows nearly cancel, and a viscosity that has changed would
 * leave a flow of its own; where the flow hardly depends on the gradient, the gradient stays.
 */
static double correction(const ehl_energy_film *film, double flow, double mobility, double p_x,
                         double carried, size_t i)
{
    const double part = 0.3;
    if (!film->through || !film->full[i])
        return 0;
    double driven = mobility * p_x, other = part * carried;
    double trust = driven * driven / (driven * driven + other * other + 1e-300);
    return mobility > 0 ? trust * (flow - film->through[i]) / mobility : 0;
}

/* Velocities, flows of mass and what Reynolds' equation takes of them, at node i, with n nodes
   across. */
FF_SIMD_INLINE void flow_across(ehl_energy *e, const ehl_energy_film *film, size_t i, size_t n)
{
    const ehl_across *a = &e->across;
    size_t at = i * n;
    double h = film->h[i], slip = film->speed[1] - film->speed[0], p_x = e->p_x[i];
    double mean = (film->speed[0] + film->speed[1]) / 2, per_p_x[EHL_ACROSS_MOST],
           driven[EHL_ACROSS_MOST] = {0};
    double *tau = e->tau + at, *gamma = e->gamma + at, *slope = e->gamma_tau + at, *u = e->u + at;
    const double *rho = e->rho + at;
    means m = means_of(e, i);
    int flows = m.slope > 1e-290;
    double tilt = flows ? m.tilt / m.slope : 0;
    double left = flows ? (slip / h - m.gamma) / m.slope : 0;
    for (size_t k = 0; k < n; k++) {
        double more = left + (a->z[k] - 0.5 - tilt) * h * p_x;
        tau[k] += more;
        gamma[k] = flows ? gamma[k] + more * slope[k] : slip / h;
        e->gamma_T[at + k] -= more * slope[k];
        per_p_x[k] = h * slope[k] * (a->z[k] - 0.5 - tilt);
    }
    e->tau_m[i] += left;
    e->mobility[i] = flows ? -h * flow_of(a, n, rho, 0, h, per_p_x, driven) : 0;
    double flow = h * flow_of(a, n, rho, film->speed[0], h, gamma, u), density = 0;
    for (size_t k = 0; k < n; k++)
        density += a->weight[k] * rho[k];
    e->mass[i] = density * h;
    e->carried[i] = (flow + e->mobility[i] * p_x) / mean;
    double more = correction(film, flow, e->mobility[i], p_x, fabs(mean) * e->mass[i], i);
    if (fabs(more) > 0) {
        for (size_t k = 0; k < n; k++) {
            tau[k] += h * (a->z[k] - 0.5 - tilt) * more;
            gamma[k] += per_p_x[k] * more;
            u[k] += driven[k] * more;
        }
    }
    e->p_x[i] += more;
    e->reverse[i] = 0;
    for (size_t k = 0; k < n; k++) {
        e->through[at + k] = rho[k] * u[k] * h;
        e->reverse[i] |= u[k] * mean < 0;
    }
}

/* The preset number of nodes is known when it is compiled. */
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
    size_t all = film->count * e->across.count;
    call_laws(e, film, T);
    for (size_t i = 0; i < film->count; i++)
        e->p_x[i] = gradient(film, i);
    if (!e->guessed)
        guess_stress(e, film);
    find_stress(e, film, T);
    for (size_t i = 0; i < film->count; i++)
        flow_at(e, film, i);
    for (size_t j = 0; j < all; j++)
        e->gamma_T[j] *= e->ln_eta_T[j];
}
