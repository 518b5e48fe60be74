/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The flanks separate and touch again. */
#include "balance.h"
#include "check.h"

#include <math.h>

static const char *model; /* the model that is tested */

/* Makes load 1 until 0.25 of the span, 0 from 0.35 to 0.6, 1 from 0.7 on, and a gap that is a
   parabola in time. */
static void separate(line *c, double gap, int sudden)
{
    line_open(c, model);
    line_last(c, 41, 800e-6);
    for (size_t i = 0; i < c->count; i++) {
        double t = (double)i / 40, down = (0.35 - t) / 0.1, up = (t - 0.6) / 0.1;
        double share = fmin(fmax(fmax(down, up), 0), 1);
        c->load[i] *= sudden ? share > 0.99 : share;
        c->gap[i] = t > 0.35 && t < 0.6 ? gap * (t - 0.35) * (0.6 - t) / (0.125 * 0.125) : 0;
    }
    stage_set(c->film, "cells", 256);
    stage_set(c->film, "steps", 400);
}

static void test_loss(double gap, int sudden)
{
    line c;
    separate(&c, gap, sudden);
    ff_status status = line_run(&c, "h_min friction_coefficient time x film pressure load_ahead");
    check_true(status == FF_OK ? "runs through" : stage_why(c.film), status == FF_OK);
    if (status != FF_OK)
        return;
    double worst = 0, before = line_value(&c, "h_min", 80), after = line_value(&c, "h_min", 400);
    double lowest = before, open = 0, bent = 0;
    for (size_t k = 0; k <= 400; k++) {
        int loaded = sudden ? k <= 90 || k >= 290 : k < 140 || k > 240;
        if (loaded)
            worst = fmax(worst, balance_load(&c, k));
        if (k % 20 == 0)
            bent = fmax(bent, balance_shape(&c, k));
        lowest = fmin(lowest, line_value(&c, "h_min", k));
        open = fmax(open, line_value(&c, "h_min", k));
    }
    check_below("load where loaded", worst, 1e-8);
    check_below("deflection at every time", bent, 1e-8);
    check_true("film stays open", lowest > 0);
    check_true("flanks part by the gap", open > 0.9 * gap);
    check_near("film comes back", after, before, 0.01);
    check_below("no friction without load", fabs(line_value(&c, "friction_coefficient", 190)), 0);
    line_close(&c);
}

/* A history that begins without load, like the engagement of a tooth. */
static void test_unloaded_start(void)
{
    line c;
    line_open(&c, model);
    line_last(&c, 5, 200e-6);
    double load = c.load[0];
    for (size_t i = 0; i < 5; i++)
        c.load[i] = load * (double)i / 4;
    stage_set(c.film, "cells", 256);
    stage_set(c.film, "steps", 100);
    check_true("starts without load", line_run(&c, "film pressure x time load_ahead") == FF_OK);
    for (size_t k = 20; k <= 100; k += 20) {
        check_below("and carries what grows", balance_load(&c, k), 1e-8);
        check_below("on bent flanks", balance_shape(&c, k), 1e-8);
    }
    line_close(&c);
}

/* Returns the gap of the history, linearly interpolated, at `share` of its span. */
static double between_rows(const line *c, double share)
{
    size_t row = (size_t)(share * 40);
    double part = share * 40 - (double)row;
    return row + 1 < c->count ? c->gap[row] * (1 - part) + c->gap[row + 1] * part : 0;
}

/* While the load is 0, the distance of the flanks must be the gap of the history, or more where the
   film carries load. Its force must stay small, and more steps must change the film after the
   impact little. */
static void test_flight(void)
{
    static line c, fine;
    separate(&c, 2e-5, 0);
    separate(&fine, 2e-5, 0);
    stage_set_text(c.film, "steps", "auto");
    stage_set(fine.film, "steps", 6400);
    check_true("runs",
               line_run(&c, "time h_min one_way_gap_error film pressure x load_ahead") == FF_OK);
    check_true("runs", line_run(&fine, "time h_min") == FF_OK);
    size_t n;
    const double *t = stage_get(c.film, "time", &n);
    double off = 0, force = 0, after = 0;
    for (size_t k = 0; k < n; k++) {
        double share = t[k] / 800e-6, gap = between_rows(&c, share);
        double h = line_value(&c, "h_min", k), lifted = line_value(&c, "one_way_gap_error", k);
        if (share > 0.4 && share < 0.58) {
            off = fmax(off, fabs(h - lifted - gap) / 2e-5);
            force = fmax(force, balance_carried(&c, k) / c.load[0]);
        }
        size_t m = (size_t)(share * 6400);
        double part = share * 6400 - (double)m,
               next = m < 6400 ? line_value(&fine, "h_min", m + 1) : 0;
        if (share > 0.62)
            after = fmax(after,
                         fabs(h / (line_value(&fine, "h_min", m) * (1 - part) + next * part) - 1));
    }
    check_below("gap of the dynamics, but for what 1 % of the load presses in", off, 5e-4);
    check_below("force of the film", force, 0.01 * (1 + 1e-6));
    check_below("film after the impact against 6400 steps", after, 0.01);
    line_close(&c);
    line_close(&fine);
}

/* Compares the film at the impact, which takes a few steps, and after it, on 512 and on 4096
   cells. */
static void test_cells(void)
{
    static line few, many;
    separate(&few, 2e-6, 0);
    separate(&many, 2e-6, 0);
    stage_set(few.film, "cells", 512);
    stage_set(many.film, "cells", 4096);
    check_true("runs", line_run(&few, "h_min h_central") == FF_OK &&
                           line_run(&many, "h_min h_central") == FF_OK);
    double landing = 0, after = 0;
    for (size_t k = 240; k <= 400; k++) { /* the load increases from 0.6 to 0.7 of the span */
        double off =
            fmax(fabs(line_value(&few, "h_min", k) / line_value(&many, "h_min", k) - 1),
                 fabs(line_value(&few, "h_central", k) / line_value(&many, "h_central", k) - 1));
        double *most = k < 280 ? &landing : &after;
        *most = fmax(*most, off);
    }
    printf("landing %.4f, after it %.4f of the film off 4096 cells\n", landing, after);
    check_below("film while it lands, against 4096 cells", landing, 0.005);
    check_below("film behind it", after, 0.005);
    line_close(&few);
    line_close(&many);
}

static void test_light_load(void)
{
    line c;
    separate(&c, 0, 0);
    stage_set(c.film, "light_load", 250);
    check_true("a load stands in", line_run(&c, "pressure x time load_ahead") == FF_OK);
    for (size_t i = 0; i < c.count; i++)
        c.load[i] = fmax(c.load[i], 250);
    double worst = 0;
    for (size_t k = 140; k <= 240; k++) /* at other instants, the load falls below the limit between
                                           two rows */
        worst = fmax(worst, balance_load(&c, k));
    check_below("the stand-in is carried at every time", worst, 1e-8);
    line_close(&c);
}

/* The whole load appears at one time, with two rows. */
static void test_jump(void)
{
    line c;
    line_open(&c, model);
    line_last(&c, 4, 100e-6);
    c.time[1] = c.time[2] = 50e-6;
    c.load[2] *= 3;
    c.load[3] *= 3;
    stage_set(c.film, "cells", 256);
    stage_set(c.film, "steps", 100);
    check_true("a jump of the load", line_run(&c, "film pressure x time load_ahead") == FF_OK);
    check_below("load and deflection before and after", balance_of_instants(&c, 101), 1e-8);
    check_near("all of it at once", balance_carried(&c, 51) + line_value(&c, "load_ahead", 51),
               c.load[2], 1e-8);
    line_close(&c);
}

enum { PARTING = 11 };

/* Runs the end of a slow tooth contact under little load, at 10 rpm and 1 N m. */
static ff_status part(line *c, const char *tolerance)
{
    static const double load[PARTING] = {578, 578, 563, 516, 420, 194, 26, 8.94, 1.344, 0, 0};
    line_open(c, model);
    line_oil(c, "viscosity/roelands", 59.07e-3, 18e-9);
    line_last(c, PARTING, 0);
    for (size_t i = 0; i < PARTING; i++) {
        c->time[i] = i > 0 ? 10e-3 + (double)i * 0.1026e-3 : 0;
        c->radius[i] = 15.2e-3;
        c->u1[i] = 25.6e-3;
        c->u2[i] = 14.5e-3;
        c->load[i] = load[i];
    }
    stage_set_text(c->film, "steps", "auto");
    stage_set_text(c->film, "time_tolerance", tolerance);
    return line_run(c, "h_min time x film pressure load_ahead");
}

/* Returns the largest relative difference of h_min from that with shorter steps, until the load is
   0. */
static double off_finer(const line *c, const line *fine)
{
    double off = 0;
    size_t n;
    const double *t = stage_get(c->film, "time", &n);
    for (size_t k = 0; k < n && t[k] < c->time[PARTING - 2]; k++)
        off = fmax(off, fabs(line_value(c, "h_min", k) / line_at(fine, "h_min", t[k]) - 1));
    return off;
}

/* The load has kinks while the flanks separate; the speed of separation must be continuous at each
   kink. */
static void test_parting(void)
{
    static const char *const tolerance[] = {"5e-3", "1.25e-3", "7e-5"};
    static line c[3];
    int found = 1;
    for (int k = 0; k < 3; k++) {
        ff_status status = part(&c[k], tolerance[k]);
        check_true(status == FF_OK ? "flanks part" : stage_why(c[k].film), status == FF_OK);
        found &= status == FF_OK;
    }
    if (found) {
        double load = 0;
        for (size_t k = 0; line_value(&c[0], "time", k) < c[0].time[PARTING - 2]; k++)
            load = fmax(load, balance_load(&c[0], k));
        check_below("load while flanks part", load, 1e-8);
        check_below("film by finer steps", off_finer(&c[1], &c[2]), off_finer(&c[0], &c[2]) / 2);
    }
    for (int k = 0; k < 3; k++)
        line_close(&c[k]);
}

int main(void)
{
    static const char *const models[] = {"ehl/finite-volume", "ehl/control-volume"};
    for (int k = 0; k < 2; k++) {
        model = models[k];
        test_loss(0, 0);
        test_loss(1e-6, 0);
        test_loss(2e-5, 0);
        test_loss(2e-5, 1);
        test_flight();
        if (k == 0)
            test_cells();
        test_unloaded_start();
        test_light_load();
        test_jump();
        test_parting();
    }
    return check_done();
}
