/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Histories from a nanosecond to days, with steps that the model chooses: the film must be that
 * of equal steps, and, if the contact changes slowly compared with the passage of the oil, the
 * steady film of each instant. Short events in a long history must not be skipped.
 *
 *   test-ehl-slow [dense]      dense: against dense-newton on 4000 equal steps, for half an hour
 */
#include "check.h"
#include "line.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static const char *const models[] = {"ehl/finite-volume", "ehl/control-volume"};

/* Opens a contact of steel on steel, 2 m/s, 177 N/mm. */
static void open_slow(line *c, const char *model, size_t count, double duration)
{
    line_open(c, model);
    line_eyring(c, 5e6);
    c->radius[0] = 12.8e-3;
    c->u1[0] = c->u2[0] = 2;
    c->load[0] = 177e3;
    if (count > 1)
        line_last(c, count, duration);
    stage_set(c->film, "cells", 192);
}

/* Returns the largest difference of an output of run a from run b, at the instants of run a. */
static double apart(const line *a, const line *b, const char *output)
{
    size_t n;
    const double *t = stage_get(a->film, "time", &n);
    double worst = 0;
    for (size_t k = 0; k < n; k++)
        worst = fmax(worst, fabs(line_value(a, output, k) / line_at(b, output, t[k]) - 1));
    return worst;
}

typedef void vary(line *c);

static void ramp(line *c)
{
    c->load[1] = 180e3;
}

/* Makes a load that oscillates by 10 %, three times. */
static void wave(line *c)
{
    for (size_t i = 0; i < c->count; i++)
        c->load[i] *= 1 + 0.1 * sin(6 * pi * (double)i / (double)(c->count - 1));
}

/* Makes a contact so lightly loaded that it stays rigid, 1 N/m, with a load that oscillates by
   half. */
static void light(line *c)
{
    for (size_t i = 0; i < 4; i++)
        c->load[i] = i == 1 ? 1.5 : i == 2 ? 0.5 : 1;
}

static void faster(line *c)
{
    c->u1[0] = c->u2[0] = 1;
    c->u1[1] = c->u2[1] = 4;
}

typedef struct history {
    const char *what;
    vary *change;
    size_t rows;
    double lasts;
} history;

static void run(line *c, const char *model, const history *h, size_t cells, size_t steps)
{
    open_slow(c, model, h->rows, h->lasts);
    h->change(c);
    stage_set(c->film, "cells", (double)cells);
    if (steps > 0)
        stage_set(c->film, "steps", (double)steps);
    check_true("runs", line_run(c, "time h_min p_max") == FF_OK);
}

/* Compares the film with that of equal steps, for each model and the model with the same equations,
   or `twin` if given. */
static void test_equal_steps(const history *h, size_t cells, size_t steps, const char *twin)
{
    static const char *const output[] = {"h_min", "p_max"};
    static line own, equal;
    char text[120];
    for (size_t k = 0; k < sizeof models / sizeof models[0]; k++) {
        if (k == 0 || !twin)
            run(&equal, twin ? twin : models[k], h, cells, steps);
        run(&own, models[k], h, cells, 0);
        for (size_t i = 0; i < 2; i++) {
            snprintf(text, sizeof text, "%s, %s in %g s: %s", models[k], h->what, h->lasts,
                     output[i]);
            check_below(text, apart(&own, &equal, output[i]), 3e-3);
        }
        line_close(&own);
        if (!twin || models[k] == models[1])
            line_close(&equal);
    }
}

/* Runs a history with a constant load on the same grid, whose last film is the steady film. */
static void rest(line *c, const char *model, double load)
{
    open_slow(c, model, 2, 1e-3);
    c->load[0] = c->load[1] = load;
    c->time[2] = c->time[1];
    c->time[1] = 0;
    c->load[0] = 180e3;
    for (size_t i = 1; i < 3; i++) {
        c->radius[i] = c->radius[0];
        c->u1[i] = c->u2[i] = 2;
        c->load[i] = load;
    }
    c->count = 3;
    check_true("runs", line_run(c, "time h_min p_max") == FF_OK);
}

static void test_steady(const char *model, double lasts)
{
    static line c, steady;
    char text[96];
    open_slow(&c, model, 2, lasts);
    ramp(&c);
    check_true("runs", line_run(&c, "time h_min p_max") == FF_OK);
    for (int k = 0; k <= 2; k++) {
        double time = lasts * k / 2, load = 177e3 + 3e3 * k / 2;
        rest(&steady, model, load);
        snprintf(text, sizeof text, "%s, ramp in %g s, %g N/mm: as steady", model, lasts,
                 load / 1e3);
        check_near(text, line_at(&c, "h_min", time), line_at(&steady, "h_min", 1e-3), 5e-3);
        check_near(text, line_at(&c, "p_max", time), line_at(&steady, "p_max", 1e-3), 5e-3);
        line_close(&steady);
    }
    line_close(&c);
}

/* A pulse of half a second in three hours, with nearly twice the load: Hertz pressure is
   proportional to the square root of the load. */
static void test_pulse(const char *model)
{
    static const double time[] = {0, 5000, 5000.25, 5000.5, 10000};
    static line c;
    open_slow(&c, model, 5, 1);
    for (size_t i = 0; i < 5; i++)
        c.time[i] = time[i];
    c.load[2] = 300e3;
    check_true("runs", line_run(&c, "time p_max_highest p_max") == FF_OK);
    check_near("a short pulse in a long history", stage_scalar(c.film, "p_max_highest"),
               line_value(&c, "p_max", 0) * sqrt(300. / 177), 5e-3);
    line_close(&c);
}

/* Runs on the default number of cells: on 256 cells, ehl/control-volume has a discretisation error
   of 0.4 %. */
static void against_dense_newton(void)
{
    static const history all[] = {
        {"three waves", wave, 301, 3}, {"1 to 4 m/s", faster, 2, 5}, {"ramp", ramp, 2, 1e-6},
        {"ramp", ramp, 2, 1e4},        {"ramp", ramp, 2, 1e-2},      {"ramp", ramp, 2, 1e-4},
        {"ramp", ramp, 2, 1},          {"ramp", ramp, 2, 1e2},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        test_equal_steps(&all[i], 512, 4000, "ehl/dense-newton");
}

int main(int argc, char **argv)
{
    static const double lasts[] = {1e-9, 1e-6, 1e-4, 1e-2, 1, 1e2, 1e5};
    if (argc > 1 && !strcmp(argv[1], "dense")) {
        against_dense_newton();
        return check_done();
    }
    for (size_t i = 0; i < sizeof lasts / sizeof lasts[0]; i++) {
        test_equal_steps(&(history){"ramp", ramp, 2, lasts[i]}, 192, 500, NULL);
        for (size_t k = 0; k < sizeof models / sizeof models[0] && lasts[i] >= 1e-2; k++)
            test_steady(models[k], lasts[i]);
    }
    test_equal_steps(&(history){"three waves", wave, 301, 3}, 192, 900, NULL);
    test_equal_steps(&(history){"1 to 4 m/s", faster, 2, 5}, 192, 900, NULL);
    test_equal_steps(&(history){"light load", light, 4, 1e3}, 192, 900, NULL);
    for (size_t k = 0; k < sizeof models / sizeof models[0]; k++)
        test_pulse(models[k]);
    return check_done();
}
