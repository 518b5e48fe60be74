/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of a film: load balance, mass conservation, an exact limit, and steady films computed by
   an independent program. */
#include "evaluation.h"
#include "offer.h"

#include <flankfilm/laws.h>

#include <math.h>

static const double pi = 3.14159265358979323846;

/* Barus' law; isoviscous if alpha is 0. */
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

/* A contact given by Moes' load number M = W/sqrt(2U) and lubricant number L = alpha E' (2U)^(1/4),
   with 2U = eta (u1 + u2)/(E' R), W = w/(E' R). */
typedef struct line_contact {
    double M, L, eta, modulus, radius, speed, load, alpha;
    oil law;
    ff_viscosity viscosity;
} line_contact;

static void make_contact(line_contact *c, double M, double L)
{
    *c = (line_contact){.M = M, .L = L, .eta = 0.01, .modulus = 226e9, .radius = 0.013, .speed = 4};
    double two_u = 2 * c->eta * c->speed / (c->modulus * c->radius);
    c->load = M * sqrt(two_u) * c->modulus * c->radius;
    c->alpha = L / (c->modulus * pow(two_u, 0.25));
    c->law = (oil){.ln_eta0 = log(c->eta), .alpha = c->alpha};
    c->viscosity = (ff_viscosity){sizeof c->viscosity, &c->law, eval};
}

/* Returns Moes' film thickness number H = (h/R)/sqrt(2U). */
static double moes_film(const line_contact *c, double h)
{
    return h / c->radius / sqrt(2 * c->eta * c->speed / (c->modulus * c->radius));
}

/* Sets the inputs at `times` instants; the load varies by the relative amplitude `swing`. */
static void give_contact(const ff_fixture *fixture, const line_contact *c, size_t times,
                         double swing)
{
    double t[64], R[64], u[64], w[64], none[64] = {0};
    for (size_t i = 0; i < times; i++) {
        t[i] = 2e-4 * (double)i / (double)times;
        R[i] = c->radius;
        u[i] = c->speed;
        w[i] = c->load * (1 + swing * sin(2 * pi * (double)i / (double)times));
    }
    fixture->give(fixture->ctx, NULL, 0, NULL, NULL);
    conformance_give_series(fixture, "contact.time", times, t);
    conformance_give_series(fixture, "contact.equivalent_radius", times, R);
    conformance_give_series(fixture, "contact.speed_1", times, u);
    conformance_give_series(fixture, "contact.speed_2", times, u);
    conformance_give_series(fixture, "contact.load_per_width", times, w);
    conformance_give_series(fixture, "contact.gap", times, none);
    conformance_give_scalar(fixture, "contact.reduced_modulus", c->modulus);
    fixture->serve(fixture->ctx, "viscosity", &c->viscosity);
    fixture->serve(fixture->ctx, "density", &liquid);
    fixture->serve(fixture->ctx, "rheology", NULL);
    fixture->set(fixture->ctx, "cells", "512");
}

/* Checks that the pressure carries the load at every instant. */
static void balance(const ff_fixture *fixture)
{
    line_contact c;
    conformance_evaluation run;
    make_contact(&c, 20, 5);
    give_contact(fixture, &c, 40, 0.2);
    fixture->set(fixture->ctx, "steps", "80");
    if (!conformance_evaluate(&run, fixture, NULL))
        return;
    conformance_array time = conformance_array_of(&run, "time"),
                      x = conformance_array_of(&run, "x"),
                      p = conformance_array_of(&run, "pressure"),
                      given = conformance_array_of(&run, "contact.time"),
                      load = conformance_array_of(&run, "contact.load_per_width");
    bool good = time.count > 1 && x.count > 1 && p.count == time.count * x.count;
    if (!good)
        fixture->skip(fixture->ctx, NULL);
    for (size_t i = 0, k = 1; i < time.count && good; i++) {
        double carried = 0;
        for (size_t j = 1; j < x.count; j++)
            carried += (x.data[j] - x.data[j - 1]) *
                       (p.data[i * x.count + j] + p.data[i * x.count + j - 1]) / 2;
        while (k + 1 < given.count && given.data[k] < time.data[i])
            k++;
        double share = (time.data[i] - given.data[k - 1]) / (given.data[k] - given.data[k - 1]);
        double asked = (1 - share) * load.data[k - 1] + share * load.data[k];
        good = conformance_near(&run, "the load that the pressure carries", i, carried, asked,
                                asked, 5e-3);
    }
    conformance_close(&run);
}

/* Returns the volume flow per width between the points i - 1 and i, m2/s. */
static double flux_at(const line_contact *c, const double *x, const double *p, const double *h,
                      size_t i)
{
    double cubes = (pow(h[i], 3) + pow(h[i - 1], 3)) / 2;
    return c->speed * (h[i] + h[i - 1]) / 2 -
           cubes / (12 * c->eta) * (p[i] - p[i - 1]) / (x[i] - x[i - 1]);
}

/* Checks that u h - h^3/(12 eta) dp/dx is the same from the inlet to film rupture. */
static void mass(const ff_fixture *fixture)
{
    line_contact c;
    conformance_evaluation run;
    if (!conformance_offers(fixture, "mass_error")) {
        fixture->skip(fixture->ctx, NULL); /* the model solves no Reynolds equation */
        return;
    }
    make_contact(&c, 20, 0);
    give_contact(fixture, &c, 1, 0);
    if (!conformance_evaluate(&run, fixture, NULL))
        return;
    conformance_array x = conformance_array_of(&run, "x"),
                      p = conformance_array_of(&run, "pressure"),
                      h = conformance_array_of(&run, "film");
    size_t top = 0;
    if (x.count < 3 || p.count != x.count || h.count != x.count) {
        fixture->skip(fixture->ctx, NULL);
        return;
    }
    for (size_t i = 0; i < x.count; i++)
        top = p.data[i] > p.data[top] ? i : top;
    double expected = flux_at(&c, x.data, p.data, h.data, top);
    bool good = top > 0;
    for (size_t i = 1; i < x.count && (i <= top || p.data[i] > 0.02 * p.data[top]) && good; i++)
        good = conformance_near(&run, "the volume flow u h - h^3/(12 eta) dp/dx", i,
                                flux_at(&c, x.data, p.data, h.data, i), expected,
                                c.speed * h.data[i], 2e-2);
    conformance_close(&run);
}

/* A rigid cylinder with isoviscous oil must have Martin's film, w h/(eta u R) = 4.86526 for an
   inlet at 20 sqrt(2 R h) (Martin 1916). */
static void rigid(const ff_fixture *fixture)
{
    const double h = 1e-6, number = 4.86526;
    char text[40];
    line_contact c;
    conformance_evaluation run;
    if (!conformance_offers(fixture, "mass_error")) {
        fixture->skip(fixture->ctx, NULL);
        return;
    }
    make_contact(&c, 1, 0);
    c.modulus = 1e18;
    c.load = number * c.eta * c.speed * c.radius / h;
    give_contact(fixture, &c, 1, 0);
    double width = sqrt(8 * c.load * c.radius / (pi * c.modulus)), inlet = sqrt(2 * c.radius * h);
    snprintf(text, sizeof text, "%.9g", 20 * inlet / width);
    fixture->set(fixture->ctx, "inlet", text);
    snprintf(text, sizeof text, "%.9g", 2 * inlet / width);
    fixture->set(fixture->ctx, "outlet", text);
    if (!conformance_evaluate(&run, fixture, "h_min"))
        return;
    conformance_near(&run, "h_min of a rigid contact", 0, conformance_scalar_of(&run, "h_min"), h,
                     h, 2e-2);
    conformance_close(&run);
}

/* Compares with central films computed by an independent program (dense Newton, extrapolated to a
   fine grid). The tolerance is 1.5 %, or twice the error that the model itself states. */
static void benchmark(const ff_fixture *fixture)
{
    static const struct {
        double M, L, film;
    } rows[] = {{20, 5, 3.5004}, {20, 0, 1.4204}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        line_contact c;
        conformance_evaluation run;
        make_contact(&c, rows[i].M, rows[i].L);
        give_contact(fixture, &c, 1, 0);
        if (!conformance_evaluate(&run, fixture, "h_central h_min_error"))
            return;
        double h = moes_film(&c, conformance_scalar_of(&run, "h_central"));
        double own = moes_film(&c, conformance_scalar_of(&run, "h_min_error"));
        double within = fmax(0.015 * rows[i].film, own > 0 ? 2 * own : 0);
        bool good = conformance_near(&run, "the steady h_central in the scale of Moes", i, h,
                                     rows[i].film, 1, within);
        conformance_close(&run);
        if (!good)
            return;
    }
}

/* The load of a rigid contact varies faster than oil can be squeezed out, with the relative
   amplitude s. A quasi-steady film would vary by the factor (1 + s)/(1 - s), as 1/w does; squeeze
   must reduce the variation to less than half of this. */
static void squeeze(const ff_fixture *fixture)
{
    const double h = 1e-6, swing = 0.5;
    char text[40];
    line_contact c;
    conformance_evaluation run;
    if (!conformance_offers(fixture, "mass_error")) {
        fixture->skip(fixture->ctx, NULL); /* the model solves no Reynolds equation */
        return;
    }
    make_contact(&c, 1, 0);
    c.modulus = 1e18;
    c.speed = 0.4; /* m/s: oil takes twice the time of the history to pass the inlet, 160 um long */
    c.load = 4.86526 * c.eta * c.speed * c.radius / h;
    give_contact(fixture, &c, 24, swing);
    double width = sqrt(8 * c.load * (1 + swing) * c.radius / (pi * c.modulus)),
           inlet = sqrt(2 * c.radius * h);
    snprintf(text, sizeof text, "%.9g", 10 * inlet / width);
    fixture->set(fixture->ctx, "inlet", text);
    snprintf(text, sizeof text, "%.9g", 2 * inlet / width);
    fixture->set(fixture->ctx, "outlet", text);
    fixture->set(fixture->ctx, "cells", "128");
    fixture->set(fixture->ctx, "steps", "40");
    if (!conformance_evaluate(&run, fixture, "time h_min"))
        return;
    conformance_array film = conformance_array_of(&run, "h_min");
    double low = INFINITY, high = 0;
    for (size_t i = 0; i < film.count; i++) {
        low = fmin(low, film.data[i]);
        high = fmax(high, film.data[i]);
    }
    double slow = (1 + swing) / (1 - swing);
    if (film.count > 4 && !(high / low - 1 < (slow - 1) / 2))
        ff_check_failf(
            fixture,
            "h_min varies between %.4g and %.4g m while the load of a rigid contact varies by 50 "
            "%% in 0.2 ms at u = %g m/s: as much as during a slow change, as if no oil had to be "
            "squeezed out",
            low, high, c.speed);
    conformance_close(&run);
}

static const ff_check checks[] = {
    {"balance", "the pressure carries the load at every instant", balance},
    {"mass", "the volume flow is the same at each section", mass},
    {"rigid", "a rigid contact with constant viscosity has Martin's film", rigid},
    {"benchmark", "smooth steady films agree with an independent program", benchmark},
    {"squeeze", "squeeze limits the variation of the film", squeeze},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks)};

CONFORMANCE_MODEL(
    "ehl", "checks of a film solution: balance of load and mass, exact and independent films",
    "Martin 1916, Engineering 102; Moes 2000, Lubrication and Beyond");
