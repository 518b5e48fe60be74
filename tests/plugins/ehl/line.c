/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "line.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

void line_open(line *c, const char *model)
{
    *c = (line){.film = stage_open(model), .count = 1, .modulus = 226.4e9};
    line_oil(c, "viscosity/roelands", 5.006e-3, 11.03e-9);
    c->rho = stage_open("density/dowson-higginson");
    stage_set(c->rho, "rho0", 917.8);
    stage_set(c->rho, "a", 0.34 / 0.59e9);
    stage_set(c->rho, "b", 1 / 0.59e9);
    c->radius[0] = 12.826e-3;
    c->u1[0] = c->u2[0] = 4.0293;
    c->load[0] = 177.363e3;
}

void line_close(line *c)
{
    stage_close(c->film);
    stage_close(c->oil);
    stage_close(c->rho);
    stage_close(c->flow);
    stage_close(c->liquid);
}

void line_grade(line *c, const char *grade, double T)
{
    stage_close(c->liquid);
    stage_close(c->oil);
    stage_close(c->rho);
    c->liquid = stage_open("lubricant/grade");
    stage_set_text(c->liquid, "grade", grade);
    stage_set(c->liquid, "temperature", T);
    stage_run(c->liquid);
    c->oil = stage_open("viscosity/roelands");
    stage_set(c->oil, "z", 0.5826);
    stage_link(c->oil, "oil", c->liquid);
    c->rho = stage_open("density/dowson-higginson");
    stage_link(c->rho, "oil", c->liquid);
    c->eta0 = stage_scalar(c->liquid, "eta0");
}

void line_oil(line *c, const char *viscosity, double eta0, double alpha)
{
    stage_close(c->oil);
    c->oil = stage_open(viscosity);
    c->eta0 = eta0;
    stage_set(c->oil, "eta0", eta0);
    if (alpha > 0)
        stage_set(c->oil, "alpha", alpha);
}

void line_incompressible(line *c)
{
    stage_close(c->rho);
    c->rho = stage_open("density/incompressible");
    stage_set(c->rho, "rho0", 917.8);
}

void line_eyring(line *c, double tau0)
{
    c->flow = stage_open("rheology/ree-eyring");
    stage_set(c->flow, "tau0", tau0);
}

static double two_u(const line *c)
{
    return 2 * c->eta0 * (c->u1[0] + c->u2[0]) / 2 / (c->modulus * c->radius[0]);
}

/* p_H = E' sqrt(W/(2 pi)) = (L/alpha) sqrt(M/(2 pi)), M = W (2U)^-1/2 */
static void set_moes(line *c, double M, double pressure)
{
    double W = 2 * pi * pow(pressure / c->modulus, 2);
    c->load[0] = W * c->modulus * c->radius[0];
    c->u1[0] = c->u2[0] = pow(W / M, 2) / 2 * c->modulus * c->radius[0] / c->eta0;
}

void line_moes(line *c, double M, double L)
{
    const double alpha = 2.2e-8, p0 = 1.96e8, z = 0.68;
    line_oil(c, "viscosity/roelands", exp(alpha * p0 / z - 9.67), alpha);
    stage_set(c->oil, "p0", p0);
    set_moes(c, M, L * sqrt(M / (2 * pi)) / alpha);
}

void line_moes_isoviscous(line *c, double M)
{
    line_oil(c, "viscosity/isoviscous", 0.03, 0);
    set_moes(c, M, 0.5e9);
}

double line_moes_film(const line *c, double h)
{
    return h / (c->radius[0] * sqrt(two_u(c)));
}

void line_last(line *c, size_t count, double duration)
{
    c->count = count;
    for (size_t i = 0; i < count; i++) {
        c->time[i] = duration * (double)i / (double)(count - 1);
        c->radius[i] = c->radius[0];
        c->u1[i] = c->u1[0];
        c->u2[i] = c->u2[0];
        c->load[i] = c->load[0];
    }
}

ff_status line_run(line *c, const char *outputs)
{
    stage_give_series(c->film, "contact.time", c->count, c->time);
    stage_give_series(c->film, "contact.equivalent_radius", c->count, c->radius);
    stage_give_series(c->film, "contact.speed_1", c->count, c->u1);
    stage_give_series(c->film, "contact.speed_2", c->count, c->u2);
    stage_give_series(c->film, "contact.load_per_width", c->count, c->load);
    stage_give_series(c->film, "contact.gap", c->count, c->gap);
    stage_give_scalar(c->film, "contact.reduced_modulus", c->modulus);
    stage_link(c->film, "viscosity", c->oil);
    stage_link(c->film, "density", c->rho);
    if (c->flow)
        stage_link(c->film, "rheology", c->flow);
    if (c->liquid) {
        stage_give_scalar(c->film, "oil.temperature", stage_scalar(c->liquid, "temperature"));
        stage_give_scalar(c->film, "oil.eta0", stage_scalar(c->liquid, "eta0"));
        stage_give_scalar(c->film, "oil.rho0", stage_scalar(c->liquid, "rho0"));
        stage_link(c->film, "oil", c->liquid);
    }
    return stage_run_wanted(c->film, outputs);
}

double line_value(const line *c, const char *output, size_t k)
{
    return stage_get(c->film, output, NULL)[k];
}

double line_at(const line *c, const char *output, double time)
{
    size_t n, k = 1;
    const double *t = stage_get(c->film, "time", &n), *y = stage_get(c->film, output, NULL);
    while (k + 1 < n && t[k] < time)
        k++;
    return y[k - 1] + (y[k] - y[k - 1]) * (time - t[k - 1]) / (t[k] - t[k - 1]);
}
