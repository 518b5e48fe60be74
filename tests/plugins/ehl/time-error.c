/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of p_max due to the time steps: for a film with a known error of pressure, for extremes
   between instants, and for whole runs compared with much shorter steps. */
#include "check.h"
#include "line.h"

#include "../../../plugins/ehl/errors/time-error.h"

#include <math.h>
#include <stdio.h>

/* The pressure P T_n(x/a) (1 - x^2/a^2)^(-1/2), with Chebyshev's polynomial T_n, has no load and
   deflects both half-planes by 4 a P/(n E') T_n, from the integral equation with a logarithmic
   kernel. */
static void test_chebyshev(int n)
{
    enum { NODES = 385 };
    const double E = 226e9, a = 1e-4, P = 1e7, dx = a / 128;
    double h[NODES], error[NODES];
    ehl_reynolds eq = {.nodes = NODES, .dx = dx, .first = -1.5 * a, .h = h};
    for (size_t i = 0; i < NODES; i++) {
        double s = (eq.first + (double)i * dx) / a;
        h[i] = 1e-6 * (1 + s * s);
        error[i] = 4 * a * P / (n * E) * cos(n * acos(fmin(1, fmax(-1, s)))) / h[i];
    }
    for (int i = 129; i < 256; i += 21) {
        double s = (eq.first + i * dx) / a, exact = P * cos(n * acos(s)) / sqrt(1 - s * s);
        char what[64];
        snprintf(what, sizeof what, "T_%d at %.3f a", n, s);
        check_below(what, fabs(ehl_pressure_of_error(&eq, error, E, a, s * a) - exact) / P, 2e-3);
    }
}

/* Unequally spaced instants of a function, in two engagements. */
static const double time_of[] = {0, 0.3, 0.4, 0.9, 1.2, 0, 0.5};
enum { INSTANTS = sizeof time_of / sizeof time_of[0] };

/* Returns the estimated difference of the maximum between instants from the largest value at an
   instant. */
static double beyond(double (*y)(double), double way)
{
    double data[INSTANTS * EHL_SERIES] = {0}, extreme = -HUGE_VAL;
    for (size_t k = 0; k < INSTANTS; k++) {
        double *row = &data[k * EHL_SERIES];
        row[EHL_TIME] = time_of[k];
        row[EHL_ENGAGEMENT] = k < 5 ? 0 : 1;
        row[EHL_P_MAX] = 3 + way * (y(time_of[k]) - (k < 5 ? 0 : 1));
        extreme = fmax(extreme, way * row[EHL_P_MAX]);
    }
    const ehl_results r = {.series = {.data = data, .count = INSTANTS, .width = EHL_SERIES}};
    return ehl_beyond_instants(&r, EHL_P_MAX, way) * fabs(extreme);
}

static double parabola(double t)
{
    return -(t - 0.55) * (t - 0.55);
}

/* The third instant is the last before the drop: a parabola through it and its neighbours is higher
   by 0.8 % of the drop. */
static double drop(double t)
{
    return 0.01 * t - (t > 0.4);
}

static double turn(double t)
{
    return t < 0.4 ? t : 0.4 - 3 * (t - 0.4);
}

static void test_between(double way)
{
    check_near("between instants", beyond(parabola, way), 0.15 * 0.15, 1e-12);
    check_below("a drop is no peak", beyond(drop, way), 1e-15);
    check_below("a break of slope is highest at its instant", beyond(turn, way), 1e-15);
}

/* Runs the load of a tooth pair, which carries alone in the middle of its engagement and shares the
   load before and after: both jumps of the load change the film, which the oil carries through the
   contact, and with it the pressure. */
static double run(double steps, double *said)
{
    static line c;
    line_open(&c, "ehl/finite-volume");
    line_last(&c, 9, 240e-6);
    for (size_t i = 0; i < c.count; i++)
        c.load[i] *= i < 3 || i > 5 ? 1 : 2;
    stage_set(c.film, "cells", 256);
    stage_set(c.film, "steps", steps);
    double highest = NAN;
    if (check_true("runs", line_run(&c, "p_max_highest") == FF_OK))
        highest = stage_scalar(c.film, "p_max_highest");
    *said = stage_quality(c.film, "p_max_time_error");
    line_close(&c);
    return highest;
}

/* The true error must be below three times the stated error, and the stated error below ten times
   the true one. */
static void test_runs(void)
{
    double none, exact = run(3200, &none);
    for (int steps = 60; steps <= 480; steps *= 2) {
        char what[64];
        double said, off = fabs(run(steps, &said) / exact - 1);
        snprintf(what, sizeof what, "%d steps: off by %.2g, said %.2g", steps, off, said);
        check_true(what, off < 3 * said && said < 10 * off);
    }
}

int main(void)
{
    for (int n = 1; n <= 4; n++)
        test_chebyshev(n);
    test_between(1);
    test_between(-1);
    test_runs();
    return check_done();
}
