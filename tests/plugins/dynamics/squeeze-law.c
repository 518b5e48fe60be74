/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The load of a rigid, isoviscous line contact with rolling and approach: compares its closed form
   with the complementarity problem solved on a grid and with limits, and the table with the closed
   form. */
#include "check.h"

#include "../../../plugins/dynamics/oil/squeeze-law.h"

#include <math.h>
#include <stdio.h>

enum { CELLS = 4000 };

/* Solves Reynolds' equation with p >= 0 on X = tan(gamma), with p in units of 12 eta u sqrt(2 R
   h)/h^2, on `cells` cells of equal gamma: (H^3 p_X)_X = 2 X - beta where p > 0. Finite volumes,
   and elimination from the inlet to the end of the film, which is moved until p and its slope
   vanish there. Returns w = 24 int p dX. */
static double obstacle(double beta, int cells)
{
    static double x[CELLS + 1], c[CELLS], s[CELLS + 1], lower[CELLS + 1], right[CELLS + 1],
        p[CELLS + 1];
    double width = M_PI / cells;
    for (int i = 0; i <= cells; i++)
        x[i] = tan(-M_PI / 2 + fmin(fmax(i, 0.02), cells - 0.02) * width);
    for (int i = 0; i < cells; i++) {
        double middle = tan(-M_PI / 2 + (i + 0.5) * width), h = 1 + middle * middle;
        c[i] = h * h * h / (x[i + 1] - x[i]);
    }
    /* the forward sweep of elimination does not depend on where the film ends */
    for (int i = 1; i < cells; i++) {
        double a = tan(-M_PI / 2 + (i - 0.5) * width), z = tan(-M_PI / 2 + (i + 0.5) * width);
        s[i] = (z - a) * (z + a - beta);
        double diagonal = c[i - 1] + c[i] - (i > 1 ? c[i - 1] * lower[i - 1] : 0);
        lower[i] = c[i] / diagonal;
        right[i] = (-s[i] + (i > 1 ? c[i - 1] * right[i - 1] : 0)) / diagonal;
    }
    int end = cells; /* the largest end of the film for which the pressure is nowhere negative */
    for (; end > 1; end--)
        if (right[end - 1] > 0)
            break;
    double sum = 0;
    p[end] = 0;
    for (int i = end - 1; i >= 1; i--) {
        p[i] = right[i] + lower[i] * p[i + 1];
        sum += p[i] * (x[i + 1] - x[i - 1]) / 2;
    }
    return 24 * sum;
}

static double load_at(double beta)
{
    double low = 1e-9, high = M_PI - 1e-9, at, w = 0;
    for (int i = 0; i < 200; i++) {
        double middle = 0.5 * (low + high);
        dynamics_squeeze_point(middle, &at, &w);
        *(at < beta ? &low : &high) = middle;
    }
    return w;
}

/* Extrapolates from two grids with second order. The error from the end of the film, which lies on
   a node, is below 5e-5. */
static void check_obstacle(void)
{
    const double betas[] = {-20, -5, -1, 0, 0.3, 1, 4, 30};
    for (size_t i = 0; i < sizeof betas / sizeof betas[0]; i++) {
        double exact = load_at(betas[i]), fine = obstacle(betas[i], CELLS);
        double coarse = obstacle(betas[i], CELLS / 2);
        double grid = fine + (fine - coarse) / 3;
        printf("beta %g: w %.8g, on a grid %.8g and %.8g\n", betas[i], exact, fine, coarse);
        check_below("complementarity on a grid less the closed form",
                    fabs(grid - exact) / (1 + exact), 5e-5);
    }
}

/* Returns the load of the full film's pressure in the front half of the contact only. */
static double half_sommerfeld(double beta)
{
    return 4 + 3 * beta * (M_PI / 2 + atan(3 * beta / 4));
}

static void check_limits(void)
{
    double beta, w;
    dynamics_squeeze_point(M_PI - 1e-5, &beta, &w);
    check_near("approach: w over 3 pi beta", w / (3 * M_PI * beta), 1, 1e-9);
    check_near("wedge alone", dynamics_squeeze_wedge(), 4.895, 1e-3);
    dynamics_squeeze_point(1e-3, &beta, &w);
    check_near("separation: w beta^2", w * beta * beta * 27 / 128, 1, 1e-4);
    check_near("half-Sommerfeld, wedge", half_sommerfeld(0), 4, 1e-12);
    double beyond = load_at(50) / half_sommerfeld(50);
    check_near("both rules agree in approach", beyond, 1, 1e-3);
    check_true("Reynolds' rule bears more", load_at(0.5) > half_sommerfeld(0.5));
    double most = 0;
    for (double b = 0.1; b < 10; b *= 1.1)
        most = fmax(most, (3 * M_PI * b + dynamics_squeeze_wedge()) / load_at(b) - 1);
    check_near("adding squeeze and wedge is too high by", most, 0.28, 0.01);
}

static void check_table(void)
{
    static dynamics_squeeze_table table;
    dynamics_squeeze_table_build(&table);
    double worst = 0, worst_slope = 0, beta, w, slope;
    for (int i = 1; i < 20000; i++) {
        double delta = M_PI * i / 20000;
        dynamics_squeeze_point(delta, &beta, &w);
        if (w < 7e-6) /* where the table continues as a straight line */
            continue;
        double got = dynamics_squeeze_beta(&table, w, &slope);
        worst = fmax(worst, fabs(got - beta) / (1 + fabs(beta)));
        double d = 1e-4 * w, ahead = dynamics_squeeze_beta(&table, w + d, &beta),
               behind = dynamics_squeeze_beta(&table, w - d, &beta);
        worst_slope = fmax(worst_slope, fabs((ahead - behind) / (2 * d) / slope - 1));
    }
    check_below("error of the table", worst, 2e-9);
    check_below("error of its slope", worst_slope, 1e-4);
    double below = dynamics_squeeze_beta(&table, -1, &slope);
    check_true("goes on straight below", below < -900 && slope > 0);
}

int main(void)
{
    check_obstacle();
    check_limits();
    check_table();
    return check_done();
}
