/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a film solution owes: load balance, mass conservation, a limit that is known exactly, and
   the smooth steady film. */
#include "look.h"
#include "offer.h"

#include <flankfilm/density.h>
#include <flankfilm/viscosity.h>

#include <math.h>

static const double pi = 3.14159265358979323846;

/* Barus' law; alpha 0: isoviscous. */
typedef struct oil {
    double ln_eta0, alpha; /* 1/Pa */
} oil;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const oil *o = self;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = o->ln_eta0 + o->alpha * p[i];
        if (dln_dp)
            dln_dp[i] = o->alpha;
        if (dln_dT)
            dln_dT[i] = 0;
    }
    return FF_OK;
}

static ff_status incompressible(const void *self, size_t n, const double *p, const double *T,
                                double *rho, double *by_p, double *by_T)
{
    (void)self, (void)p, (void)T;
    for (size_t i = 0; i < n; i++) {
        rho[i] = 900;
        if (by_p)
            by_p[i] = 0;
        if (by_T)
            by_T[i] = 0;
    }
    return FF_OK;
}

static const ff_density liquid = {sizeof liquid, NULL, incompressible};

/* A contact in the dimensionless groups of Moes: M = W/sqrt(2U), L = alpha E' (2U)^(1/4), with
   2U = eta (u1 + u2)/(E' R), W = w/(E' R). */
typedef struct line {
    double M, L, eta, modulus, radius, speed, load, alpha;
    oil law;
    ff_viscosity viscosity;
} line;

static void line_make(line *c, double M, double L)
{
    *c = (line){.M = M, .L = L, .eta = 0.01, .modulus = 226e9, .radius = 0.013, .speed = 4};
    double two_u = 2 * c->eta * c->speed / (c->modulus * c->radius);
    c->load = M * sqrt(two_u) * c->modulus * c->radius;
    c->alpha = L / (c->modulus * pow(two_u, 0.25));
    c->law = (oil){.ln_eta0 = log(c->eta), .alpha = c->alpha};
    c->viscosity = (ff_viscosity){sizeof c->viscosity, &c->law, eval};
}

/* H of Moes: (h/R)/sqrt(2U). */
static double line_film(const line *c, double h)
{
    return h / c->radius / sqrt(2 * c->eta * c->speed / (c->modulus * c->radius));
}

/* Feeds `times` instants, the load swinging by `swing` of itself. */
static void line_give(const ff_bench *bench, const line *c, size_t times, double swing)
{
    double t[64], R[64], u[64], w[64], none[64] = {0};
    for (size_t i = 0; i < times; i++) {
        t[i] = 2e-4 * (double)i / (double)times;
        R[i] = c->radius;
        u[i] = c->speed;
        w[i] = c->load * (1 + swing * sin(2 * pi * (double)i / (double)times));
    }
    bench->give(bench->ctx, NULL, 0, NULL, NULL);
    give_series(bench, "contact.time", times, t);
    give_series(bench, "contact.equivalent_radius", times, R);
    give_series(bench, "contact.speed_1", times, u);
    give_series(bench, "contact.speed_2", times, u);
    give_series(bench, "contact.load_per_width", times, w);
    give_series(bench, "contact.gap", times, none);
    give_scalar(bench, "contact.reduced_modulus", c->modulus);
    bench->serve(bench->ctx, "viscosity", &c->viscosity);
    bench->serve(bench->ctx, "density", &liquid);
    bench->serve(bench->ctx, "rheology", NULL);
    bench->set(bench->ctx, "cells", "512");
}

/* The pressure carries the load at every instant. */
static void balance(const ff_bench *bench)
{
    line c;
    look l;
    line_make(&c, 20, 5);
    line_give(bench, &c, 40, 0.2);
    bench->set(bench->ctx, "steps", "80");
    if (!look_open(&l, bench, NULL))
        return;
    series time = look_at(&l, "time"), x = look_at(&l, "x"), p = look_at(&l, "pressure"),
           given = look_at(&l, "contact.time"), load = look_at(&l, "contact.load_per_width");
    bool good = time.count > 1 && x.count > 1 && p.count == time.count * x.count;
    if (!good)
        bench->untried(bench->ctx, NULL);
    for (size_t i = 0, k = 1; i < time.count && good; i++) {
        double carried = 0;
        for (size_t j = 1; j < x.count; j++)
            carried += (x.data[j] - x.data[j - 1]) *
                       (p.data[i * x.count + j] + p.data[i * x.count + j - 1]) / 2;
        while (k + 1 < given.count && given.data[k] < time.data[i])
            k++;
        double share = (time.data[i] - given.data[k - 1]) / (given.data[k] - given.data[k - 1]);
        double asked = (1 - share) * load.data[k - 1] + share * load.data[k];
        good = look_near(&l, "the load that the pressure carries", i, carried, asked, asked, 5e-3);
    }
    look_close(&l);
}

/* Between the points i - 1 and i. */
static double flux_at(const line *c, const double *x, const double *p, const double *h, size_t i)
{
    double cubes = (pow(h[i], 3) + pow(h[i - 1], 3)) / 2;
    return c->speed * (h[i] + h[i - 1]) / 2 -
           cubes / (12 * c->eta) * (p[i] - p[i - 1]) / (x[i] - x[i - 1]);
}

/* u h - h^3/(12 eta) dp/dx is the same from the inlet to where the film breaks. */
static void mass(const ff_bench *bench)
{
    line c;
    look l;
    if (!look_offers(bench, "mass_error")) {
        bench->untried(bench->ctx, NULL); /* it solves no equation of Reynolds */
        return;
    }
    line_make(&c, 20, 0);
    line_give(bench, &c, 1, 0);
    if (!look_open(&l, bench, NULL))
        return;
    series x = look_at(&l, "x"), p = look_at(&l, "pressure"), h = look_at(&l, "film");
    size_t top = 0;
    if (x.count < 3 || p.count != x.count || h.count != x.count) {
        bench->untried(bench->ctx, NULL);
        return;
    }
    for (size_t i = 0; i < x.count; i++)
        top = p.data[i] > p.data[top] ? i : top;
    double expected = flux_at(&c, x.data, p.data, h.data, top);
    bool good = top > 0;
    for (size_t i = 1; i < x.count && (i <= top || p.data[i] > 0.02 * p.data[top]) && good; i++)
        good =
            look_near(&l, "the volume flow u h - h^3/(12 eta) dp/dx", i,
                      flux_at(&c, x.data, p.data, h.data, i), expected, c.speed * h.data[i], 2e-2);
    look_close(&l);
}

/* Rigid cylinder, isoviscous oil (Martin 1916): w h/(eta u R) = 4.86526 with an inlet at
   20 sqrt(2 R h). */
static void rigid(const ff_bench *bench)
{
    const double h = 1e-6, number = 4.86526;
    char text[40];
    line c;
    look l;
    if (!look_offers(bench, "mass_error")) {
        bench->untried(bench->ctx, NULL);
        return;
    }
    line_make(&c, 1, 0);
    c.modulus = 1e18;
    c.load = number * c.eta * c.speed * c.radius / h;
    line_give(bench, &c, 1, 0);
    double width = sqrt(8 * c.load * c.radius / (pi * c.modulus)), inlet = sqrt(2 * c.radius * h);
    snprintf(text, sizeof text, "%.9g", 20 * inlet / width);
    bench->set(bench->ctx, "inlet", text);
    snprintf(text, sizeof text, "%.9g", 2 * inlet / width);
    bench->set(bench->ctx, "outlet", text);
    if (!look_open(&l, bench, "h_min"))
        return;
    look_near(&l, "h_min of a rigid contact", 0, look_scalar(&l, "h_min"), h, h, 2e-2);
    look_close(&l);
}

/* Central films of an independent program (dense Newton, extrapolated to a fine grid), to 1.5 % or
   twice the error that the model itself states. */
static void benchmark(const ff_bench *bench)
{
    static const struct {
        double M, L, film;
    } rows[] = {{20, 5, 3.5004}, {20, 0, 1.4204}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        line c;
        look l;
        line_make(&c, rows[i].M, rows[i].L);
        line_give(bench, &c, 1, 0);
        if (!look_open(&l, bench, "h_central h_min_error"))
            return;
        double h = line_film(&c, look_scalar(&l, "h_central"));
        double own = line_film(&c, look_scalar(&l, "h_min_error"));
        double within = fmax(0.015 * rows[i].film, own > 0 ? 2 * own : 0);
        bool good = look_near(&l, "the steady h_central in the scale of Moes", i, h, rows[i].film,
                              1, within);
        look_close(&l);
        if (!good)
            return;
    }
}

static const ff_check checks[] = {
    {"balance", "the pressure carries the load at every instant", balance},
    {"mass", "as much oil leaves a section as enters it", mass},
    {"rigid", "a rigid contact of constant viscosity meets Martin's film", rigid},
    {"benchmark", "smooth steady films are those of the literature", benchmark},
};

static const ff_conformance asks = {.size = sizeof asks, .checks = FF_TABLE(checks)};

static const void *service(void *self, uint32_t output)
{
    (void)self, (void)output;
    return &asks;
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = "conformance/ehl",
    .version = "1.0.0",
    .summary = "what a film solution keeps: balance of load and mass, exact and published films",
    .reference = "Martin 1916, Engineering 102; Moes 2000, Lubrication and Beyond",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .outputs = FF_TABLE(offer_outputs),
    .create = offer_create,
    .service = service,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
