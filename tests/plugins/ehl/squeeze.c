/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts that start, stop, reverse, or get a sudden load: films without entrainment are
   squeezed. */
#include "check.h"
#include "line.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static const char *const models[] = {"ehl/finite-volume", "ehl/control-volume", "ehl/dense-newton"};

static void open_case(line *c, const char *model, size_t count, const double *time,
                      const double *speed)
{
    line_open(c, model);
    line_last(c, count, 1);
    for (size_t i = 0; i < count; i++) {
        c->time[i] = time[i];
        c->u1[i] = c->u2[i] = speed[i];
    }
    stage_set(c->film, "cells", strstr(model, "dense") ? 96 : 384);
}

static void runs(line *c, const char *outputs)
{
    ff_status status = line_run(c, outputs);
    check_true(status == FF_OK ? "runs" : stage_why(c->film), status == FF_OK);
}

/* A rigid cylinder of radius R sinks towards a plane through an oil of constant viscosity at speed
   V: p = 6 eta V R/h^2, and under the load w per width h(t)^-1/2 = h(0)^-1/2 + w t/(6 pi eta R
   sqrt(2 R)). */
static double sunk(const line *c, double gap, double load, double time)
{
    double R = c->radius[0];
    return pow(1 / sqrt(gap) + load * time / (6 * pi * c->eta0 * R * sqrt(2 * R)), -2);
}

static void test_cylinder(const char *model)
{
    enum { TIMES = 8 };
    static const double still[3] = {0};
    const double gap = 2e-6, load = 100, end = 1.4e-3, time[3] = {0, 0, end};
    static line c;
    char text[96];
    open_case(&c, model, 3, time, still);
    line_oil(&c, "viscosity/isoviscous", 5e-3, 0);
    line_incompressible(&c);
    c.modulus = 1e16;
    c.gap[0] = gap;
    c.load[0] = 0;
    c.load[1] = c.load[2] = load;
    runs(&c, "time h_min load_error");
    double within = 3e-3 * (strstr(model, "dense") ? 16 : 1); /* discretisation error, of second
                                                                 order */
    for (int k = 1; k <= TIMES; k++) {
        double t = end * k / TIMES;
        snprintf(text, sizeof text, "%s: film of a sinking cylinder at %.3g s", model, t);
        check_near(text, line_at(&c, "h_min", t), sunk(&c, gap, load, t), within);
    }
    line_close(&c);
}

/* Reversed motion must give the mirror image, and end with the steady film of the reversed
   direction. */
static void test_reversal(const char *model)
{
    const double time[4] = {0, 1e-4, 2e-4, 8e-4}, there[4] = {2, 2, -2, -2},
                 back[4] = {-2, -2, 2, 2};
    static line a, b;
    open_case(&a, model, 4, time, there);
    open_case(&b, model, 4, time, back);
    stage_set(a.film, "tolerance", 1e-5);
    stage_set(b.film, "tolerance", 1e-5);
    runs(&a, "time h_min film x mass_error");
    runs(&b, "time h_min film x");
    size_t n, steps;
    const double *x = stage_get(a.film, "x", &n), *f = stage_get(a.film, "film", NULL),
                 *g = stage_get(b.film, "film", NULL), *t = stage_get(a.film, "time", &steps);
    double worst = 0, turned = 0, lowest = 1;
    const double *first = f, *last = f + (steps - 1) * n, *other = g + (steps - 1) * n;
    for (size_t i = 0; i < n; i++) {
        worst = fmax(worst, fabs(last[i] / other[n - 1 - i] - 1));
        if (fabs(x[i]) < 2e-4)
            turned = fmax(turned, fabs(last[i] / first[n - 1 - i] - 1));
    }
    for (size_t k = 0; k < steps && t[k] <= 3e-4; k++)
        lowest = fmin(lowest, line_value(&a, "h_min", k));
    check_below("the other way is the mirror image", worst, 1e-12);
    check_below("settles as the film of the other way", turned, 2e-3);
    check_true("the film collapses as it turns", lowest < 0.8 * line_value(&a, "h_min", 0));
    check_below("balance", stage_quality(a.film, "load_balance"), 1e-8);
    check_below("balance", stage_quality(a.film, "mass_balance"), 1e-4);
    line_close(&a);
    line_close(&b);
}

/* The flanks stop under load, rest, and move again. */
static void test_stop(const char *model)
{
    const double time[5] = {0, 2e-4, 1e-3, 1.2e-3, 2e-3}, speed[5] = {2, 0, 0, 2, 2};
    static line c;
    open_case(&c, model, 5, time, speed);
    runs(&c, "time h_min h_central");
    double stopped = line_at(&c, "h_min", 2e-4), stood = line_at(&c, "h_min", 1e-3);
    check_true("stands on an ever thinner film", stood > 0 && stood < 0.9 * stopped);
    check_true("which is shut in",
               line_at(&c, "h_central", 1e-3) > 0.9 * line_at(&c, "h_central", 2e-4));
    check_near("goes on as before", line_at(&c, "h_min", 2e-3), line_at(&c, "h_min", 0), 5e-3);
    line_close(&c);
}

/* If the flanks start from rest, the film of a very low speed replaces the first film, and a
   quality line reports for how long. */
static void test_start(const char *model)
{
    const double time[3] = {0, 1e-3, 2e-3}, speed[3] = {0, 2, 2}, steady[3] = {2, 2, 2};
    static line c, b;
    open_case(&c, model, 3, time, speed);
    open_case(&b, model, 3, time, steady);
    runs(&c, "time h_min");
    runs(&b, "time h_min");
    double share = line_value(&c, "h_min", 0) / line_value(&b, "h_min", 0);
    check_true("begins with a hundredth of the speed, to the power 0.7 or so",
               share > 0.02 && share < 0.06);
    check_near("ends with the steady film", line_at(&c, "h_min", 2e-3), line_at(&b, "h_min", 2e-3),
               5e-3);
    check_true("says so",
               stage_verdict(c.film) == FF_DOUBTFUL && stage_quality(c.film, "start_at_rest") > 0);
    line_close(&c);
    line_close(&b);
}

/* With two rows at the first time, the film must begin with the first row and jump to the second,
   as if it were a nanosecond later. */
static void test_jump_at_the_start(const char *model)
{
    enum { TIMES = 20 };
    const double now[3] = {0, 0, 2e-4}, soon[3] = {0, 1e-9, 2e-4}, speed[3] = {4.03, 4.03, 4.03};
    static line a, b;
    open_case(&a, model, 3, now, speed);
    open_case(&b, model, 3, soon, speed);
    a.load[0] = b.load[0] = 88.7e3;
    runs(&a, "time h_min p_max");
    runs(&b, "time h_min p_max");
    check_near("begins with the film before", line_value(&a, "h_min", 0),
               line_value(&b, "h_min", 0), 1e-6);
    for (int k = 1; k <= TIMES; k++) {
        double t = 2e-4 * k / TIMES;
        check_near("jumps at once", line_at(&a, "h_min", t), line_at(&b, "h_min", t), 2e-3);
    }
    line_close(&a);
    line_close(&b);
}

/* A domain that ends inside the film must be reported, one that ends beyond it must not. */
static void test_outlet(const char *model)
{
    static const double outlet[] = {0.95, 1.02, 1.3};
    line c;
    for (int k = 0; k < 3; k++) {
        line_open(&c, model);
        stage_set(c.film, "cells", strstr(model, "dense") ? 192 : 512);
        stage_set(c.film, "inlet", 6);
        stage_set(c.film, "outlet", outlet[k]);
        runs(&c, "h_min");
        double share = stage_quality(c.film, "outlet_load");
        check_true("a cut exit", k < 2 ? share > 2.5e-3 : share < 1e-9);
        line_close(&c);
    }
}

int main(void)
{
    for (size_t k = 0; k < sizeof models / sizeof models[0]; k++) {
        test_cylinder(models[k]);
        test_outlet(models[k]);
        if (strstr(models[k], "dense")) /* ehl/dense-newton takes too long on as many cells */
            continue;
        test_reversal(models[k]);
        test_stop(models[k]);
        test_start(models[k]);
        test_jump_at_the_start(models[k]);
    }
    return check_done();
}
