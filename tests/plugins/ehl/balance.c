/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "balance.h"

#include <flankfilm/density.h>
#include <flankfilm/rheology.h>
#include <flankfilm/viscosity.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* Interpolates the values `row` of a history linearly at a time. */
static double at_time(const line *c, const double *row, double time)
{
    size_t i = c->count - 1;
    while (i > 0 && c->time[i] > time)
        i--;
    if (i + 1 == c->count || !(c->time[i + 1] > c->time[i]))
        return row[i];
    double part = (time - c->time[i]) / (c->time[i + 1] - c->time[i]);
    return row[i] + part * (row[i + 1] - row[i]);
}

static double time_of(const line *c, size_t k)
{
    return c->count > 1 ? line_value(c, "time", k) : c->time[0];
}

/* Returns the values of an output of the film at instant k. */
static const double *field(const line *c, const char *output, size_t k, size_t *nodes)
{
    size_t n;
    stage_get(c->film, "x", &n);
    *nodes = n;
    return stage_get(c->film, output, NULL) + k * n;
}

double balance_carried(const line *c, size_t k)
{
    size_t n;
    const double *p = field(c, "pressure", k, &n), *x = stage_get(c->film, "x", NULL);
    double sum = 0;
    for (size_t i = 0; i + 1 < n; i++)
        sum += (p[i] + p[i + 1]) / 2 * (x[i + 1] - x[i]);
    return sum;
}

double balance_load(const line *c, size_t k)
{
    double carried = balance_carried(c, k) + line_value(c, "load_ahead", k);
    double time = time_of(c, k), most = 0;
    double off = fabs(carried - at_time(c, c->load, time));
    for (size_t i = 0; i < c->count; i++) {
        most = fmax(most, c->load[i]);
        if (c->time[i] >= time && c->time[i] <= time)
            off = fmin(off, fabs(carried - c->load[i]));
    }
    return off / most;
}

/* Whether the load is so small at a time, or on one side of a jump of the load, that the flanks may
   separate. */
static int is_light(const line *c, double time)
{
    double load = at_time(c, c->load, time), most = 0;
    load = fmin(load, at_time(c, c->load, time * (1 - 1e-14)));
    for (size_t i = 0; i < c->count; i++)
        most = fmax(most, c->load[i]);
    return load <= 0.01 * most;
}

double balance_of_instants(const line *c, size_t count)
{
    double worst = 0;
    size_t all = 1;
    if (c->count > 1)
        stage_get(c->film, "time", &all);
    for (size_t k = 1; k <= count; k++) {
        size_t at = k * all / count;
        at = at > 0 ? at - 1 : 0;
        double off = balance_load(c, at);
        if (is_light(c, time_of(c, at)))
            off = fmax(0, off - 0.01 * (1 + 1e-6));
        worst = fmax(worst, fmax(off, balance_shape(c, at)));
    }
    return worst;
}

/* int ln|s| ds */
static double log_integral(double s)
{
    return fabs(s) > 0 ? s * log(fabs(s)) - s : 0;
}

double balance_shape(const line *c, size_t k)
{
    size_t n;
    const double *p = field(c, "pressure", k, &n), *h = field(c, "film", k, &n),
                 *x = stage_get(c->film, "x", NULL);
    double dx = x[1] - x[0], radius = at_time(c, c->radius, time_of(c, k)), least = h[0];
    double low = HUGE_VAL, high = -HUGE_VAL, *kernel = malloc(n * sizeof *kernel);
    for (size_t j = 0; j < n; j++) /* of a cell of pressure 1 */
        kernel[j] = -4 * dx / (pi * c->modulus) *
                    (log_integral((double)j + 0.5) - log_integral((double)j - 0.5));
    for (size_t i = 0; i < n; i++) {
        double v = 0;
        for (size_t j = 0; j < n; j++)
            v += kernel[i > j ? i - j : j - i] * p[j];
        double rest = h[i] - x[i] * x[i] / (2 * radius) - v;
        low = fmin(low, rest);
        high = fmax(high, rest);
        least = fmin(least, h[i]);
    }
    free(kernel);
    return (high - low) / least;
}

typedef struct oil {
    const ff_viscosity *eta;
    const ff_density *rho;
    const ff_rheology *flow; /* NULL: Newtonian */
} oil;

/* Computes m = rho h at each node, and q, the mass flow through the face downstream of the node. */
static void flows(const line *c, const oil *o, size_t k, double *m, double *q)
{
    size_t n;
    const double *p = field(c, "pressure", k, &n), *h = field(c, "film", k, &n),
                 *x = stage_get(c->film, "x", NULL);
    double u1 = at_time(c, c->u1, time_of(c, k)), u2 = at_time(c, c->u2, time_of(c, k));
    for (size_t i = 0; i < n; i++) {
        double rho;
        o->rho->eval(o->rho->self, 1, &p[i], NULL, &rho, NULL, NULL);
        m[i] = rho * h[i];
    }
    for (size_t i = 0; i + 1 < n; i++) {
        double gap = (h[i] + h[i + 1]) / 2, mean = (p[i] + p[i + 1]) / 2, rho, ln_eta, psi;
        o->rho->eval(o->rho->self, 1, &mean, NULL, &rho, NULL, NULL);
        o->eta->eval(o->eta->self, 1, &mean, NULL, &ln_eta, NULL, NULL);
        psi = exp(-ln_eta);
        if (o->flow)
            o->flow->flow(o->flow->self, 1, &ln_eta, &gap, u1 - u2, &psi, NULL, NULL);
        q[i] = (u1 + u2) / 2 * (m[i] + m[i + 1]) / 2 -
               rho * gap * gap * gap * psi / 12 * (p[i + 1] - p[i]) / (x[i + 1] - x[i]);
    }
}

static oil oil_of(const line *c)
{
    return (oil){stage_service(c->oil, FF_VISCOSITY_ID), stage_service(c->rho, FF_DENSITY_ID),
                 c->flow ? stage_service(c->flow, FF_RHEOLOGY_ID) : NULL};
}

static size_t centre_of(const double *x, size_t n)
{
    size_t centre = 0;
    for (size_t i = 0; i < n; i++)
        centre = fabs(x[i]) < fabs(x[centre]) ? i : centre;
    return centre;
}

/* Returns the mass flow u rho0 h_central. */
static double passing(const line *c, const oil *o, size_t k)
{
    size_t n;
    const double *h = field(c, "film", k, &n);
    double time = time_of(c, k), rho, none = 0;
    o->rho->eval(o->rho->self, 1, &none, NULL, &rho, NULL, NULL);
    return rho * h[centre_of(stage_get(c->film, "x", NULL), n)] *
           (at_time(c, c->u1, time) + at_time(c, c->u2, time)) / 2;
}

double balance_flow(const line *c)
{
    const oil o = oil_of(c);
    size_t n, first = 0, last = 0, top = 0;
    const double *p = field(c, "pressure", 0, &n);
    double *m = malloc(2 * n * sizeof *m), *q = m + n, off = 0;
    flows(c, &o, 0, m, q);
    for (size_t i = 0; i < n; i++)
        top = p[i] > p[top] ? i : top;
    for (size_t i = 0; i < n; i++) {
        last = p[i] > 0.01 * p[top] ? i : last;
        first = first == 0 && p[i] > 0.01 * p[top] ? i : first;
    }
    for (size_t i = first; i < last; i++)
        off += fabs(q[0] - q[i]) / (double)(last - first);
    free(m);
    return off / passing(c, &o, 0);
}

double balance_cells(const line *c)
{
    size_t n;
    const double *h = field(c, "film", 0, &n), *x = stage_get(c->film, "x", NULL);
    double R = c->radius[0], middle = h[centre_of(x, n)];
    double a = sqrt(8 * c->load[0] * R / (pi * c->modulus));
    double rise = a * pow(3 * middle * R / (2 * sqrt(2) * a * a), 2. / 3);
    return fmin(rise, sqrt(2 * R * middle)) / (x[1] - x[0]);
}

double balance_history(const line *c)
{
    const oil o = oil_of(c);
    size_t n, count;
    stage_get(c->film, "time", &count);
    stage_get(c->film, "x", &n);
    const double *x = stage_get(c->film, "x", NULL);
    double *memory = calloc(5 * n, sizeof *memory), *sum = memory, *m = memory + n, *q = m + n,
           *old = q + n, *before = old + n, worst = 0, all = 0;
    size_t middle = centre_of(x, n);
    flows(c, &o, 0, old, before);
    for (size_t k = 1; k < count; k++) {
        double dt = time_of(c, k) - time_of(c, k - 1), gained = 0;
        flows(c, &o, k, m, q);
        for (size_t i = 1; i <= middle; i++) {
            gained += (m[i] - old[i]) * (x[1] - x[0]);
            sum[i] += dt * (q[0] + before[0] - q[i] - before[i]) / 2 - gained;
            worst = fmax(worst, fabs(sum[i]));
        }
        all += dt * (passing(c, &o, k) + passing(c, &o, k - 1)) / 2;
        memcpy(old, m, n * sizeof *m);
        memcpy(before, q, n * sizeof *q);
    }
    free(memory);
    return worst / all;
}
