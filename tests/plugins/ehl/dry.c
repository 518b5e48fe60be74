/* SPDX-License-Identifier: GPL-3.0-or-later */
/* At low speed, with valleys from which oil escapes sideways, the oil carries no load: the pressure
   is that of the dry rough contact, elastic, or plastic with a hardness that no pressure exceeds
   (Almqvist et al. 2007). This convex problem with one solution is solved here by projected
   gradients. */
#include "check.h"
#include "flank.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CELLS = 192, NODES = CELLS + 1, ROUNDS = 500 };

static const double pi = 3.14159265358979323846;

typedef struct dry {
    double gap[NODES], p[NODES], plastic[NODES], kernel[NODES];
} dry;

static double log_integral(double s)
{
    return fabs(s) > 0 ? s * log(fabs(s)) - s : 0;
}

/* Returns the mean height over a cell; the record is linear between its points. */
static double mean_height(const flank *f, double x, double dx)
{
    enum { PARTS = 200 };
    double sum = 0;
    for (int k = 0; k < PARTS; k++) {
        double s = x + dx * ((k + 0.5) / PARTS - 0.5), place = s / f->period;
        place = (place - floor(place)) * FLANK_POINTS;
        size_t i = (size_t)place % FLANK_POINTS, next = (i + 1) % FLANK_POINTS;
        double part = place - floor(place);
        for (int g = 0; g < 2; g++)
            sum += (1 - part) * f->height[g][i] + part * f->height[g][next];
    }
    return sum / PARTS;
}

/* Computes p = q - shift, limited to 0 <= p <= most, with the shift for which p adds up to `sum`,
   load/dx. */
static void project(const double *q, double most, double sum, double *p)
{
    double low = -2 * most, high = 2 * most;
    for (int k = 0; k < 60; k++) {
        double shift = (low + high) / 2, all = 0;
        for (size_t i = 1; i + 1 < NODES; i++)
            all += p[i] = fmin(fmax(q[i] - shift, 0), most);
        *(all > sum ? &low : &high) = shift;
    }
}

/* Minimises p K p/2 + gap p for 0 <= p <= most and a given load, by projected gradients with
   momentum (Beck & Teboulle 2009), restarted if the momentum points uphill. K: kernel. Returns the
   last change of p over the largest p. */
static double solve_dry(dry *d, double load, double dx, double most)
{
    double rest[NODES], next[NODES] = {0}, ahead[NODES], longest = 0, t = 1, moved, highest;
    for (size_t i = 0; i < NODES; i++) /* a constant in the kernel has no effect at a given load */
        longest += 2 * fabs(d->kernel[i] - d->kernel[NODES / 2]);
    memset(d->p, 0, sizeof d->p);
    project(d->p, most, load / dx, d->p);
    memcpy(ahead, d->p, sizeof ahead);
    for (int round = 0; round < ROUNDS; round++) {
        double uphill = 0, before = t;
        moved = highest = 0;
        for (size_t i = 0; i < NODES; i++) {
            rest[i] = d->gap[i];
            for (size_t j = 0; j < NODES; j++)
                rest[i] += (d->kernel[i > j ? i - j : j - i] - d->kernel[NODES / 2]) * ahead[j];
            rest[i] = ahead[i] - rest[i] / longest;
        }
        project(rest, most, load / dx, next);
        for (size_t i = 0; i < NODES; i++)
            uphill += (ahead[i] - next[i]) * (next[i] - d->p[i]);
        t = uphill > 0 ? 1 : (1 + sqrt(1 + 4 * t * t)) / 2;
        for (size_t i = 0; i < NODES; i++) {
            ahead[i] = next[i] + (uphill > 0 ? 0 : (before - 1) / t) * (next[i] - d->p[i]);
            moved = fmax(moved, fabs(next[i] - d->p[i]));
            highest = fmax(highest, next[i]);
            d->p[i] = next[i];
        }
    }
    return moved / highest;
}

static ff_status run_slowly(line *c, const flank *f, double hardness)
{
    line_open(c, "ehl/finite-volume");
    line_oil(c, "viscosity/isoviscous", 1e-3, 0);
    c->u1[0] *= 1e-3;
    c->u2[0] *= 1e-3;
    stage_set(c->film, "cells", CELLS);
    stage_set(c->film, "inlet", 2);
    stage_set(c->film, "outlet", 2);
    stage_set_text(c->film, "valleys", "ventilated");
    stage_set(c->film, "valley_length", 20e-6);
    stage_set(c->film, "asperity_hardness", hardness);
    flank_give(f, c->film);
    return line_run(c, "pressure film plastic_depth asperity_load_share yield_share x");
}

/* Solves the dry contact of these flanks at the nodes x. The plastic depth is the part of the
   overlap that elastic deflection does not remove. */
static void find_dry(dry *d, const line *c, const flank *f, const double *x, double hardness)
{
    double dx = x[1] - x[0], contact = HUGE_VAL, most = hardness > 0 ? hardness : 1e12;
    for (size_t i = 0; i < NODES; i++) {
        double s = (double)i, ln = log_integral(s + 0.5) - log_integral(s - 0.5) + log(dx / 1e-4);
        d->kernel[i] = -4 * dx / (pi * c->modulus) * ln;
        d->gap[i] = x[i] * x[i] / (2 * c->radius[0]) - mean_height(f, x[i], dx);
    }
    check_below("the dry contact is found", solve_dry(d, c->load[0], dx, most), 1e-9);
    for (size_t i = 0; i < NODES; i++) {
        d->plastic[i] = -d->gap[i];
        for (size_t j = 0; j < NODES; j++)
            d->plastic[i] -= d->kernel[i > j ? i - j : j - i] * d->p[j];
        contact = d->p[i] > 0 && d->p[i] < most ? fmin(contact, -d->plastic[i]) : contact;
    }
    for (size_t i = 0; i < NODES; i++)
        d->plastic[i] = d->p[i] < most ? 0 : d->plastic[i] + contact;
}

/* Returns the L2 norm of the difference of two arrays over the norm of the second. */
static double distance(const double *y, const double *right)
{
    double off = 0, all = 0;
    for (size_t i = 0; i < NODES; i++) {
        off += (y[i] - right[i]) * (y[i] - right[i]);
        all += right[i] * right[i];
    }
    return sqrt(off / all);
}

/* Returns by how much the film, minus the gap, deflection and plastic depth from the model's
   pressure, varies over the nodes. Nodes beyond 0.2 mm are left out, where the model smooths the
   flanks at the start. */
static double off_the_gap(const dry *d, const line *c)
{
    const double *x = stage_get(c->film, "x", NULL), *h = stage_get(c->film, "film", NULL);
    const double *p = stage_get(c->film, "pressure", NULL),
                 *plastic = stage_get(c->film, "plastic_depth", NULL);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < NODES && x[i] < 2e-4; i++) {
        double rest = h[i] - d->gap[i] - plastic[i];
        for (size_t j = 0; j < NODES; j++)
            rest -= d->kernel[i > j ? i - j : j - i] * p[j];
        low = fmin(low, rest);
        high = fmax(high, rest);
    }
    return high - low;
}

static void test_limit(unsigned seed, double hardness)
{
    static flank f;
    static dry d;
    char name[96];
    line c;
    flank_random(&f, seed, 0.5e-6, 40e-6, 400e-6);
    ff_status status = run_slowly(&c, &f, hardness);
    snprintf(name, sizeof name, "seed %u runs %s", seed, status == FF_OK ? "" : stage_why(c.film));
    if (check_true(name, status == FF_OK)) {
        find_dry(&d, &c, &f, stage_get(c.film, "x", NULL), hardness);
        snprintf(name, sizeof name, "seed %u, H %.2g GPa: dry pressure", seed, 1e-9 * hardness);
        check_below(name, distance(stage_get(c.film, "pressure", NULL), d.p), 0.01);
        snprintf(name, sizeof name, "seed %u: load that the oil still carries", seed);
        check_below(name, 1 - line_value(&c, "asperity_load_share", 0), 0.03);
        check_below("film: the gap that this pressure leaves, over Rq",
                    off_the_gap(&d, &c) / f.rq[0], 1e-4);
    }
    if (status == FF_OK && hardness > 0) {
        snprintf(name, sizeof name, "seed %u: %.3g of the load on metal that yields", seed,
                 line_value(&c, "yield_share", 0));
        check_true(name, line_value(&c, "yield_share", 0) > 0.1);
        snprintf(name, sizeof name, "seed %u: plastic part", seed);
        check_below(name, distance(stage_get(c.film, "plastic_depth", NULL), d.plastic), 2e-3);
    }
    line_close(&c);
}

int main(void)
{
    for (unsigned seed = 1; seed < 4; seed++) {
        test_limit(seed, 0);
        test_limit(seed, 1.5e9);
    }
    return check_done();
}
