/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Central film of smooth steady contacts against extrapolated solutions of an independent program
 * (dense Newton, penalty cavitation, Hertz scaling), in Moes' scale; order of convergence; and the
 * consistency of compressible films with Moes 2000. With the argument `all`: every case.
 */
#include "line.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct row {
    double M, L; /* L = 0: isoviscous */
    char law;    /* c: compressible Roelands, i: incompressible, B: incompressible Barus */
    int always;
    double inlet, outlet, h_central, within;
} row;

static const row rows[] = {
    {5, 5, 'c', 1, 12, 2.5, 3.8753, 0.01},   {10, 5, 'c', 0, 8, 2, 3.4601, 0.01},
    {20, 5, 'c', 1, 4, 1.5, 3.0807, 0.01},   {50, 5, 'c', 1, 4, 1.5, 2.6407, 0.01},
    {20, 10, 'c', 0, 4, 1.5, 4.360, 0.01},   {50, 10, 'c', 0, 4, 1.5, 3.811, 0.01},
    {100, 10, 'c', 1, 4, 1.5, 3.4361, 0.01}, {200, 10, 'c', 0, 4, 1.5, 3.100, 0.01},
    {20, 5, 'i', 0, 4, 1.5, 3.4190, 0.01},   {20, 5, 'B', 1, 4, 1.5, 3.5004, 0.01},
    {20, 10, 'B', 0, 4, 1.5, 5.2636, 0.01},  {50, 10, 'B', 0, 4, 1.5, 4.7496, 0.01},
    {20, 0, 'i', 1, 6, 1.5, 1.4204, 0.01},   {50, 0, 'i', 0, 6, 1.5, 1.1593, 0.01},
    {100, 0, 'i', 1, 6, 1.5, 1.0016, 0.02},
};

/* Moes 2000, incompressible. */
static double moes(double M, double L)
{
    double ri = 3 / M, ei = 2.621 * pow(M, -0.2), rp = 1.287 * pow(L, 2. / 3),
           ep = 1.311 * pow(M, -0.125) * pow(L, 0.75), s = (7 + 8 * exp(-2 * ei / ri)) / 5;
    return pow(pow(pow(ri, 7. / 3) + pow(ei, 7. / 3), 3 * s / 7) +
                   pow(pow(rp, -3.5) + pow(ep, -3.5), -2 * s / 7),
               1 / s);
}

/* H_c on `cells`; *density: rho/rho0 at x = 0; *resolved: cells over the inlet's pressure rise. */
static double central(const row *r, size_t cells, double *density, double *resolved)
{
    line c;
    line_open(&c, "ehl/finite-volume");
    if (r->L > 0)
        line_moes(&c, r->M, r->L);
    else
        line_moes_isoviscous(&c, r->M);
    if (r->law != 'c')
        line_incompressible(&c);
    if (r->law == 'B')
        line_oil(&c, "viscosity/barus", c.eta0, 2.2e-8);
    stage_set(c.film, "cells", (double)cells);
    stage_set(c.film, "inlet", r->inlet);
    stage_set(c.film, "outlet", r->outlet);
    stage_set(c.film, "tolerance", 1e-8);
    if (line_run(&c, "h_central pressure x") != FF_OK)
        check_true(stage_why(c.film), 0);
    size_t nodes, centre = 0;
    const double *x = stage_get(c.film, "x", &nodes), *p = stage_get(c.film, "pressure", NULL);
    for (size_t i = 0; i < nodes; i++)
        centre = fabs(x[i]) < fabs(x[centre]) ? i : centre;
    *resolved = stage_quality(c.film, "film_resolution");
    *density = 1 + 0.34 * p[centre] / (0.59e9 + p[centre]);
    double h = line_moes_film(&c, line_value(&c, "h_central", 0));
    line_close(&c);
    return h;
}

static void test_row(const row *r)
{
    double rho, resolved, fine = central(r, 1024, &rho, &resolved);
    char name[64];
    snprintf(name, sizeof name, "M %g L %g %c", r->M, r->L, r->law);
    check_near(name, fine, r->h_central, r->within);
    if (r->law == 'c')
        check_near("consistent with Moes", rho * fine, moes(r->M, r->L), 0.025);
}

/* On three grids of which the coarsest resolves the inlet. */
static void test_order(const row *r)
{
    double rho, resolved = 0, h[3] = {0};
    char name[80];
    size_t cells = 128;
    while (resolved < 8)
        h[0] = central(r, cells *= 2, &rho, &resolved);
    h[1] = central(r, 2 * cells, &rho, &resolved);
    h[2] = central(r, 4 * cells, &rho, &resolved);
    double ratio = (h[1] - h[0]) / (h[2] - h[1]);
    snprintf(name, sizeof name, "M %g L %g %c, from %zu cells: error falls %.2f times", r->M, r->L,
             r->law, cells, ratio);
    check_true(name, ratio > 3 && ratio < 5);
}

int main(int argc, char **argv)
{
    int all = argc > 1 && !strcmp(argv[1], "all");
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++)
        if (all || rows[k].always) {
            test_row(&rows[k]);
            test_order(&rows[k]);
        }
    return check_done();
}
