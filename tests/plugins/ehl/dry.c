/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Slowly, and with valleys that are open sideways, the oil carries nothing: the pressure is that of
 * the dry rough contact, a convex problem with one solution. It is solved here by an active set of
 * its own: the gap is closed where p > 0, and open elsewhere.
 */
#include "flank.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CELLS = 192, NODES = CELLS + 1, ROUNDS = 200 };

static const double pi = 3.14159265358979323846;

typedef struct dry {
    double x[NODES], gap[NODES], p[NODES], kernel[NODES];
    double matrix[NODES + 1][NODES + 2];
    int closed[NODES];
} dry;

static double log_integral(double s)
{
    return fabs(s) > 0 ? s * log(fabs(s)) - s : 0;
}

/* Mean over a cell of the record, linear between its points. */
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

/* Gauss's elimination with row pivots; the solution replaces the last column. */
static void eliminate(dry *d, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        size_t pivot = k;
        for (size_t i = k + 1; i < n; i++)
            pivot = fabs(d->matrix[i][k]) > fabs(d->matrix[pivot][k]) ? i : pivot;
        for (size_t j = k; j <= n; j++) {
            double other = d->matrix[k][j];
            d->matrix[k][j] = d->matrix[pivot][j];
            d->matrix[pivot][j] = other;
        }
        for (size_t i = 0; i < n; i++) {
            double factor = i == k ? 0 : d->matrix[i][k] / d->matrix[k][k];
            for (size_t j = k; j <= n && i != k; j++)
                d->matrix[i][j] -= factor * d->matrix[k][j];
        }
    }
    for (size_t k = 0; k < n; k++)
        d->matrix[k][n] /= d->matrix[k][k];
}

/* Pressures of the closed nodes that keep them closed and sum to the load; the rigid approach is
   returned. Pressures are in `unit`. */
static double close_gaps(dry *d, double load, double dx, double unit)
{
    size_t place[NODES], n = 0;
    for (size_t i = 0; i < NODES; i++)
        if (d->closed[i])
            place[n++] = i;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            size_t apart = place[i] > place[j] ? place[i] - place[j] : place[j] - place[i];
            d->matrix[i][j] = d->kernel[apart] * unit;
        }
        d->matrix[i][n] = 1e-6;
        d->matrix[i][n + 1] = -d->gap[place[i]];
        d->matrix[n][i] = 1e-6;
    }
    d->matrix[n][n] = 0;
    d->matrix[n][n + 1] = 1e-6 * load / (dx * unit);
    eliminate(d, n + 1);
    memset(d->p, 0, sizeof d->p);
    for (size_t i = 0; i < n; i++)
        d->p[place[i]] = unit * d->matrix[i][n + 1];
    return 1e-6 * d->matrix[n][n + 1];
}

static int solve_dry(dry *d, double load, double dx, double unit)
{
    for (int round = 0; round < ROUNDS; round++) {
        double approach = close_gaps(d, load, dx, unit);
        int changed = 0;
        for (size_t i = 1; i + 1 < NODES; i++) {
            double open = d->gap[i] + approach;
            for (size_t j = 0; j < NODES; j++)
                open += d->kernel[i > j ? i - j : j - i] * d->p[j];
            int closed = d->closed[i] ? d->p[i] > 0 : open < 0;
            changed |= closed != d->closed[i];
            d->closed[i] = closed;
        }
        if (!changed)
            return 1;
    }
    return 0;
}

static void test_limit(unsigned seed)
{
    static flank f;
    static dry d;
    char name[96];
    line c;
    flank_random(&f, seed, 0.5e-6, 40e-6, 400e-6);
    line_open(&c, "ehl/finite-volume");
    line_oil(&c, "viscosity/isoviscous", 1e-3, 0);
    c.u1[0] *= 1e-3;
    c.u2[0] *= 1e-3;
    stage_set(c.film, "cells", CELLS);
    stage_set(c.film, "inlet", 2);
    stage_set(c.film, "outlet", 2);
    stage_set_text(c.film, "valleys", "ventilated");
    stage_set(c.film, "valley_length", 20e-6);
    flank_give(&f, c.film);
    ff_status status = line_run(&c, "pressure asperity_load_share x load_error");
    snprintf(name, sizeof name, "seed %u runs %s", seed, status == FF_OK ? "" : stage_why(c.film));
    if (!check_true(name, status == FF_OK)) {
        line_close(&c);
        return;
    }
    const double *p = stage_get(c.film, "pressure", NULL), *x = stage_get(c.film, "x", NULL);
    double dx = x[1] - x[0], off = 0, all = 0;
    for (size_t i = 0; i < NODES; i++) {
        double s = (double)i, ln = log_integral(s + 0.5) - log_integral(s - 0.5) + log(dx / 1e-4);
        d.kernel[i] = -4 * dx / (pi * c.modulus) * ln;
        d.gap[i] = x[i] * x[i] / (2 * c.radius[0]) - mean_height(&f, x[i], dx);
        d.closed[i] = i > 0 && i + 1 < NODES && fabs(x[i]) < 1.6e-4;
    }
    check_true("the dry contact is found", solve_dry(&d, c.load[0], dx, 1e9));
    for (size_t i = 0; i < NODES; i++) {
        off += (p[i] - d.p[i]) * (p[i] - d.p[i]);
        all += d.p[i] * d.p[i];
    }
    snprintf(name, sizeof name, "seed %u: dry pressure, L2", seed);
    check_below(name, sqrt(off / all), 0.02);
    snprintf(name, sizeof name, "seed %u: load that the oil still carries", seed);
    check_below(name, 1 - line_value(&c, "asperity_load_share", 0), 0.1);
    check_below("load balance", line_value(&c, "load_error", 0), 1e-8);
    line_close(&c);
}

int main(void)
{
    for (unsigned seed = 1; seed < 4; seed++)
        test_limit(seed);
    return check_done();
}
