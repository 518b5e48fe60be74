/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flanks that yield where the pressure reaches their hardness H: compares them with the closed form
   of a dry smooth contact, and checks conditions at every node and instant. The dry rough contact
   is in dry.c. */
#include "check.h"
#include "flank.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* Complete elliptic integrals of modulus m by the arithmetic-geometric mean. */
static void elliptic(double m, double *K, double *E)
{
    double a = 1, b = sqrt(1 - m * m), sum = m * m / 2, weight = 0.5;
    for (int k = 0; k < 12; k++) {
        double c = (a - b) / 2, mean = (a + b) / 2;
        b = sqrt(a * b);
        a = mean;
        weight *= 2;
        sum += weight * c * c;
    }
    *K = pi / (2 * a);
    *E = *K * (1 - sum);
}

/* The dry contact of a cylinder with p = H for |x| < c, which falls to 0 at a, docs/theory.md (8.5)
   to (8.7); m = c/a. */
typedef struct capped {
    double m, a, b, c, slope; /* slope: E'/(4 R) */
    double volume;            /* integral of the plastic part, m2 */
} capped;

/* (p_Hertz/H)^2 */
static double excess(double m)
{
    double K, E;
    elliptic(m, &K, &E);
    return 4 / (pi * pi) * (2 * E * K - (1 - m * m) * K * K);
}

static capped closed_form(const line *c, double hertz, double hardness)
{
    double low = 0, high = 1 - 1e-15, K, E, R = c->radius[0];
    for (int k = 0; k < 200; k++) {
        double m = (low + high) / 2;
        *(excess(m) < pow(hertz / hardness, 2) ? &low : &high) = m;
    }
    elliptic(low, &K, &E);
    double square = low * low, a = 8 * R * hardness * K / (pi * c->modulus);
    return (capped){.m = low,
                    .a = a,
                    .b = a * sqrt(1 - E / K),
                    .c = low * a,
                    .slope = c->modulus / (4 * R),
                    .volume =
                        a * a * a / R *
                        (((2 + square) * K - 2 * (1 + square) * E) / 3 - (1 - E / K) * (K - E))};
}

/* Returns p for c < |x| < a from its slope (8.5), by Simpson's rule in t, x^2 = c^2 + (a^2 - c^2)
   sin^2 t. */
static double closed_pressure(const capped *s, double hardness, double x)
{
    enum { PARTS = 40 };
    if (fabs(x) <= s->c)
        return hardness;
    if (fabs(x) >= s->a)
        return 0;
    double wide = s->a * s->a - s->c * s->c, sum = 0;
    double from = asin(sqrt((x * x - s->c * s->c) / wide)), part = (pi / 2 - from) / PARTS;
    for (int k = 0; k <= PARTS; k++) {
        double at = sqrt(s->c * s->c + wide * pow(sin(from + k * part), 2));
        int weight = k == 0 || k == PARTS ? 1 : k % 2 ? 4 : 2;
        sum += weight * (at - s->b * s->b / at);
    }
    return s->slope * sum * part / 3;
}

static double hertz_pressure(const line *c)
{
    return sqrt(c->load[0] * c->modulus / (2 * pi * c->radius[0]));
}

/* Opens a contact of smooth flanks, so slow that the oil carries almost no load. */
static void open_dry(line *c, size_t cells, double hardness_over_hertz)
{
    static flank f;
    flank_random(&f, 1, 0, 40e-6, 400e-6);
    line_open(c, "ehl/finite-volume");
    line_oil(c, "viscosity/isoviscous", 1e-3, 0);
    c->u1[0] *= 1e-3;
    c->u2[0] *= 1e-3;
    stage_set(c->film, "cells", (double)cells);
    stage_set(c->film, "inlet", 2);
    stage_set(c->film, "outlet", 2);
    stage_set(c->film, "asperity_hardness", hardness_over_hertz * hertz_pressure(c));
    flank_give(&f, c->film);
}

static double log_integral(double s)
{
    return fabs(s) > 0 ? s * log(fabs(s)) - s : 0;
}

/* Returns by how much the film, minus x^2/(2 R), the deflection by direct sums and the plastic
   part, varies over the nodes, over the contact film of 1 nm. */
static double gap_error(const line *c, size_t nodes)
{
    const double *x = stage_get(c->film, "x", NULL), *p = stage_get(c->film, "pressure", NULL),
                 *h = stage_get(c->film, "film", NULL),
                 *plastic = stage_get(c->film, "plastic_depth", NULL);
    double dx = x[1] - x[0], low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 1; i + 1 < nodes; i++) {
        double rest = h[i] - plastic[i] - x[i] * x[i] / (2 * c->radius[0]);
        for (size_t j = 0; j < nodes; j++) {
            double s = (double)i - (double)j, ln = log_integral(s + 0.5) - log_integral(s - 0.5);
            rest += 4 * dx / (pi * c->modulus) * p[j] * (ln + log(dx / 1e-4));
        }
        low = fmin(low, rest);
        high = fmax(high, rest);
    }
    return (high - low) / 1e-9;
}

static void test_closed_form(size_t cells, double part)
{
    line c;
    char name[96];
    open_dry(&c, cells, part);
    double hertz = hertz_pressure(&c), H = part * hertz, volume = 0, off = 0, all = 0;
    ff_status status = line_run(&c, "pressure film plastic_depth yield_share x load_error");
    if (check_true(status == FF_OK ? "runs" : stage_why(c.film), status == FF_OK)) {
        capped exact = closed_form(&c, hertz, H);
        const double *x = stage_get(c.film, "x", NULL), *p = stage_get(c.film, "pressure", NULL),
                     *plastic = stage_get(c.film, "plastic_depth", NULL);
        double dx = x[1] - x[0], share = line_value(&c, "yield_share", 0);
        for (size_t i = 0; i <= cells; i++) {
            double right = closed_pressure(&exact, H, x[i]);
            volume += dx * plastic[i];
            off += pow(p[i] - right, 2);
            all += right * right;
        }
        snprintf(name, sizeof name, "%zu cells, H %.2g p_Hertz: pressure, L2", cells, part);
        check_below(name, sqrt(off / all), 1.3 / (double)cells);
        check_near("volume of the plastic part", volume, exact.volume, 2e-3);
        /* the ends of the plastic zone lie within a cell */
        check_near("length at H", share * c.load[0] / H, 2 * exact.c, dx / exact.c);
        check_below("gap less the plastic part: that of elastic flanks", gap_error(&c, cells + 1),
                    1e-6);
        check_below("load balance", line_value(&c, "load_error", 0), 1e-8);
    }
    line_close(&c);
}

/* Opens a contact with sliding, for 1.5 passages of the oil. */
static void open_rough(line *c, const flank *f, size_t cells, size_t steps, double hardness)
{
    line_open(c, "ehl/finite-volume");
    line_eyring(c, 5e6);
    c->u1[0] *= 0.11;
    c->u2[0] *= 0.09;
    line_last(c, 2, 1.2e-3);
    stage_set(c->film, "cells", (double)cells);
    stage_set(c->film, "steps", (double)steps);
    stage_set(c->film, "asperity_hardness", hardness);
    flank_give(f, c->film);
}

typedef struct means {
    double share, volume;
} means;

/* At every node and instant: 0 <= plastic, p <= H and plastic (H - p) = 0. */
static means test_rough(size_t cells, double hardness)
{
    static flank f;
    line c;
    means y = {0};
    double outside = 0;
    flank_random(&f, 2, 0.5e-6, 60e-6, 400e-6);
    open_rough(&c, &f, cells, 60, hardness);
    ff_status status = line_run(&c, "pressure plastic_depth x yield_share plastic_depth_max "
                                    "load_error mass_error");
    if (check_true(status == FF_OK ? "runs" : stage_why(c.film), status == FF_OK)) {
        size_t all, times;
        const double *p = stage_get(c.film, "pressure", &all), *x = stage_get(c.film, "x", NULL),
                     *plastic = stage_get(c.film, "plastic_depth", NULL),
                     *share = stage_get(c.film, "yield_share", &times),
                     *load = stage_get(c.film, "load_error", NULL),
                     *mass = stage_get(c.film, "mass_error", NULL);
        for (size_t i = 0; i < all; i++) {
            outside = fmax(outside, fmax(p[i] / hardness - 1, -plastic[i]));
            outside = fmax(outside, p[i] < hardness ? plastic[i] : 0);
            y.volume += plastic[i] * (x[1] - x[0]) / (double)times;
        }
        check_true("plastic where p is H alone, and p nowhere above it", outside <= 0);
        outside = 0;
        for (size_t k = 0; k < times; k++) {
            y.share += share[k] / (double)times;
            outside = fmax(outside, fmax(load[k] / 1e-8, mass[k] / 1e-4));
        }
        check_true("load and mass are kept at every instant", outside <= 1);
        check_below("no cell holds more than its gap", stage_quality(c.film, "complementarity"),
                    1e-4);
        check_below("yield_complementarity", stage_quality(c.film, "yield_complementarity"), 1e-9);
        check_below("work of the flanks and moment of the pressure",
                    stage_quality(c.film, "rolling_moment"), 1e-9);
        printf(
            "%zu cells, %.3g GPa: %.4f of the load on metal that yields, plastic part %.4g um2\n",
            cells, 1e-9 * hardness, y.share, 1e12 * y.volume);
    }
    line_close(&c);
    return y;
}

/* The steady dry contact must converge for every hardness: during the iteration, nodes become full,
   empty and plastic in a different order for each. */
static void test_steady(void)
{
    enum { CONTACTS = 12 };
    int found = 0;
    for (int k = 0; k < CONTACTS; k++) {
        line c;
        open_dry(&c, 128, 0.8 + 0.01 * k);
        found += line_run(&c, "h_min") == FF_OK;
        line_close(&c);
    }
    check_near("steady dry contacts that are found", found, CONTACTS, 0);
}

/* If no node yields, every bit of the result must be equal. */
static void test_elastic(void)
{
    static flank f;
    double last[2] = {0};
    flank_random(&f, 1, 0.5e-6, 60e-6, 400e-6);
    for (int k = 0; k < 2; k++) {
        line c;
        open_rough(&c, &f, 128, 20, k ? 1e12 : 0);
        ff_status status = line_run(&c, "p_max h_min yield_share");
        if (check_true(status == FF_OK ? "runs" : stage_why(c.film), status == FF_OK)) {
            last[k] = line_value(&c, "p_max", 20) + line_value(&c, "h_min", 20);
            check_true("nothing yields", !(line_value(&c, "yield_share", 20) > 0));
        }
        line_close(&c);
    }
    check_near("a hardness above every pressure: the bits of none", last[1], last[0], 0);
}

static void test_refusal(void)
{
    line c;
    open_dry(&c, 64, 0.99 * pi / 4);
    check_true("a hardness that cannot carry the load is refused",
               line_run(&c, "h_min") == FF_INVALID &&
                   !strcmp(stage_why_item(c.film), "asperity_hardness"));
    const double low = 0.99 * pi / 4 * hertz_pressure(&c);
    stage_set_text(c.film, "asperity_hardness", NULL);
    stage_give_series(c.film, "gear.hardness", 2, (double[]){1e12, low});
    check_true("that of the softer gear, too",
               line_run(&c, "h_min") == FF_INVALID &&
                   !strcmp(stage_why_item(c.film), "gear.hardness"));
    stage_give_series(c.film, "gear.hardness", 2, (double[]){1e12, 0});
    check_true("and one that is not known", line_run(&c, "h_min") == FF_INVALID &&
                                                !strcmp(stage_why_item(c.film), "gear.hardness"));
    line_close(&c);
}

int main(void)
{
    for (size_t cells = 128; cells <= 256; cells *= 2)
        for (double part = 0.8; part < 0.91; part += 0.1)
            test_closed_form(cells, part);
    test_steady();
    means coarse = test_rough(256, 1.5e9), fine = test_rough(512, 1.5e9);
    test_rough(128, 0.7e9); /* a hardness a little above the contact's mean pressure, where cavities
                               appear and vanish */
    check_true("metal yields", fine.share > 0.05);
    check_near("share of the load at H, half the cells", coarse.share, fine.share, 0.05);
    check_near("plastic part, half the cells", coarse.volume, fine.volume, 0.01);
    test_elastic();
    test_refusal();
    return check_done();
}
