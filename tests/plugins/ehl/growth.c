/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The number of iterations of a time step must hardly depend on the number of cells. */
#include "check.h"
#include "line.h"

#include <math.h>
#include <stdio.h>

/* Counts iterations for a load that rises and falls by a twentieth. */
static void test_counts(size_t cells)
{
    enum { STEPS = 150 };
    line c;
    char name[80];
    line_open(&c, "ehl/finite-volume");
    line_last(&c, 200, 1.2e-3);
    for (size_t i = 0; i < c.count; i++)
        c.load[i] *= 1 + sin(2 * acos(-1) * (double)i / 199) / 20;
    stage_set(c.film, "cells", (double)cells);
    stage_set(c.film, "steps", STEPS);
    check_true("runs to the end",
               line_run(&c, "h_min newton_steps convolutions steps_cut") == FF_OK);
    double newton = stage_scalar(c.film, "newton_steps") / STEPS,
           convolutions = stage_scalar(c.film, "convolutions") / STEPS;
    snprintf(name, sizeof name, "%zu cells: %.2f Newton steps in a time step", cells, newton);
    check_below(name, newton, 2.2);
    snprintf(name, sizeof name, "%zu cells: %.2f convolutions in a time step", cells, convolutions);
    check_below(name, convolutions, 7);
    line_close(&c);
}

static double steady(double M, double L, size_t cells, double *newton)
{
    line c;
    line_open(&c, "ehl/finite-volume");
    line_moes(&c, M, L);
    stage_set(c.film, "cells", (double)cells);
    check_true("has a steady film", line_run(&c, "h_central newton_steps") == FF_OK);
    double h = line_value(&c, "h_central", 0);
    *newton = stage_scalar(c.film, "newton_steps");
    line_close(&c);
    return h;
}

/* On a fine grid, the first film must need few steps of Newton's method. With 1023 cells, there is
   no coarser grid to start from, but the film must be the same. */
static void test_start(double M, double L)
{
    double newton, plain, nested = steady(M, L, 1024, &newton);
    char name[96];
    snprintf(name, sizeof name, "M %g L %g: nested grids", M, L);
    check_near(name, nested, steady(M, L, 1023, &plain), 2e-4);
    steady(M, L, 4096, &newton);
    snprintf(name, sizeof name, "M %g L %g: Newton steps at 4096 cells", M, L);
    check_below(name, newton, 10);
}

static double soft(const char *model, double load, size_t cells)
{
    line c;
    line_open(&c, model);
    line_oil(&c, "viscosity/isoviscous", 4.9e-3, 0);
    line_incompressible(&c);
    c.radius[0] = 26.73e-3;
    c.u1[0] = 3.469 * 1.052;
    c.u2[0] = 3.469 * 0.948;
    c.load[0] = load;
    c.modulus = 0.14672e9;
    stage_set(c.film, "cells", (double)cells);
    check_true("has a soft film", line_run(&c, "h_central") == FF_OK);
    double h = line_value(&c, "h_central", 0);
    line_close(&c);
    return h;
}

/* Contacts a quarter as wide as the coarse system's blocks of 16 cells: at none of many loads may
   the solver stop before long waves have converged. The reference is ehl/dense-newton at every
   REACH-th load; ln(h) is interpolated by a cubic through four of these. */
static void test_soft(size_t cells)
{
    enum { LOADS = 116, REACH = 6, KNOWN = LOADS / REACH + 2 };
    static const double ratio = 1.03;
    double known[KNOWN];
    for (size_t k = 0; k < KNOWN; k++)
        known[k] = log(soft("ehl/dense-newton", pow(ratio, (double)(REACH * k)), cells));
    for (size_t i = 0; i < LOADS; i++) {
        double load = pow(ratio, (double)i), at = (double)i / REACH, dense = 0;
        size_t first = i < REACH ? 0 : i / REACH - 1;
        first = first > KNOWN - 4 ? KNOWN - 4 : first;
        for (size_t k = first; k < first + 4; k++) {
            double part = known[k];
            for (size_t l = first; l < first + 4; l++)
                part *= l == k ? 1 : (at - (double)l) / ((double)k - (double)l);
            dense += part;
        }
        char name[80];
        snprintf(name, sizeof name, "soft contact, %g N/m, %zu cells: dense-newton", load, cells);
        check_near(name, soft("ehl/finite-volume", load, cells), exp(dense), 1e-3);
    }
}

int main(void)
{
    test_soft(256);
    test_soft(288);
    for (size_t cells = 512; cells <= 4096; cells *= 2)
        test_counts(cells);
    for (double M = 1; M < 2000; M *= 10)
        for (double L = 5; L < 30; L *= 2)
            test_start(M, L);
    return check_done();
}
