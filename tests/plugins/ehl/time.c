/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film in a smooth cycle of load: balances at every step, order in time, independence of the
   grid, and the mirrored film for reversed motion. */
#include "balance.h"
#include "check.h"

#include <math.h>
#include <stdio.h>

static const double pi = 3.14159265358979323846;
static const double span = 400e-6; /* s; the film passes the contact in 80e-6 s */

/* Makes the load 1 + 0.3 (1 - cos) over the span. */
static void cycle(line *c, size_t cells, size_t steps, const char *scheme, double tolerance)
{
    line_open(c, "ehl/finite-volume");
    line_eyring(c, 5e6);
    c->u1[0] *= 1.1;
    c->u2[0] *= 0.9;
    line_last(c, 41, span);
    for (size_t i = 0; i < c->count; i++)
        c->load[i] *= 1 + 0.3 * (1 - cos(2 * pi * c->time[i] / span));
    stage_set(c->film, "cells", (double)cells);
    stage_set(c->film, "steps", (double)steps);
    stage_set_text(c->film, "time_scheme", scheme);
    stage_set(c->film, "tolerance", tolerance);
}

static double largest(const line *c, const char *output)
{
    size_t n;
    const double *x = stage_get(c->film, output, &n);
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = fmax(most, fabs(x[i]));
    return most;
}

static void test_balances(void)
{
    line c;
    cycle(&c, 256, 80, "bdf2", 1e-10);
    check_true("runs",
               line_run(&c, "mass_error h_min film pressure x time load_ahead "
                            "h_min_lowest p_max_highest p_max traction sliding_loss") == FF_OK);
    check_below("load and deflection at every step", balance_of_instants(&c, 81), 1e-8);
    check_below("mass balance at every step", largest(&c, "mass_error"), 1e-8);
    check_true("quality is good", stage_verdict(c.film) == FF_GOOD);
    check_near("last time", line_value(&c, "time", 80), span, 1e-12);
    check_near("highest pressure", stage_scalar(c.film, "p_max_highest"), largest(&c, "p_max"), 0);
    check_near("loss", line_value(&c, "sliding_loss", 7),
               line_value(&c, "traction", 7) * (c.u1[0] - c.u2[0]), 1e-12);
    line_close(&c);
    cycle(&c, 512, 1000, "bdf2", 1e-5);
    line_run(&c, "convolutions film pressure x time load_ahead");
    check_below("load and deflection at a loose tolerance", balance_of_instants(&c, 50), 1e-7);
    check_below("convolutions per step", stage_scalar(c.film, "convolutions") / 1000, 6);
    line_close(&c);
}

/* The mass flow of a steady film must be the same everywhere, and mass must be in balance in a
   cycle, to errors of second order. */
static void test_flow(void)
{
    double steady[2], through[2];
    for (size_t k = 0; k < 2; k++) {
        line c;
        cycle(&c, (size_t)256 << k, (size_t)160 << k, "bdf2", 1e-8);
        check_true("runs", line_run(&c, "film pressure x time load_ahead") == FF_OK);
        steady[k] = balance_flow(&c);
        through[k] = balance_history(&c);
        line_close(&c);
    }
    check_near("steady flow: error of 256 cells over that of 512", steady[0] / steady[1], 4, 0.1);
    check_true("flow through a cycle: error falls with cells and steps",
               through[1] < through[0] / 2);
    check_below("steady flow", steady[1], 4e-3);
    check_below("flow through a cycle", through[1], 6e-3);
}

static double central(size_t cells, size_t steps, const char *scheme, size_t k)
{
    line c;
    cycle(&c, cells, steps, scheme, 1e-8);
    line_run(&c, "h_central");
    double h = line_value(&c, "h_central", k);
    line_close(&c);
    return h;
}

static void test_order(const char *scheme, double low, double high)
{
    double h[3];
    for (size_t k = 0; k < 3; k++) {
        size_t steps = (size_t)160 << k;
        h[k] = central(128, steps, scheme, 3 * steps / 4);
    }
    double ratio = (h[1] - h[0]) / (h[2] - h[1]);
    char name[64];
    snprintf(name, sizeof name, "%s: error falls %.2f times as the step is halved", scheme, ratio);
    check_true(name, ratio > low && ratio < high);
}

static void test_grid(void)
{
    double h[3];
    for (size_t k = 0; k < 3; k++)
        h[k] = central((size_t)256 << k, 160, "bdf2", 120);
    check_near("512 cells against 1024", h[1], h[2], 2e-3);
    check_below("second order in space", fabs(h[2] - h[1]) / fabs(h[1] - h[0]), 0.35);
}

/* The estimated error must be at least the true error, and at most five times as large. */
static void test_estimate(const char *film, const char *estimate)
{
    line coarse, fine;
    char name[96];
    cycle(&coarse, 256, 40, "bdf2", 1e-6);
    cycle(&fine, 1024, 640, "bdf2", 1e-6);
    snprintf(name, sizeof name, "%s %s", film, estimate);
    line_run(&coarse, name);
    line_run(&fine, film);
    double worst = 0, claimed = 0;
    for (size_t k = 0; k <= 40; k++) {
        worst = fmax(worst, fabs(line_value(&coarse, film, k) - line_value(&fine, film, 16 * k)));
        claimed = fmax(claimed, line_value(&coarse, estimate, k));
    }
    snprintf(name, sizeof name, "%s: error %.2g m, estimate %.2g m: covers it, at most fivefold",
             film, worst, claimed);
    check_true(name, claimed > worst && claimed < 5 * worst);
    line_close(&coarse);
    line_close(&fine);
}

/* If both surfaces move towards -x, the film must be the mirror image, with traction of opposite
   sign. */
static void test_mirror(void)
{
    line a, b;
    cycle(&a, 128, 20, "bdf2", 1e-6);
    cycle(&b, 128, 20, "bdf2", 1e-6);
    for (size_t i = 0; i < b.count; i++) {
        b.u1[i] = -b.u1[i];
        b.u2[i] = -b.u2[i];
    }
    line_run(&a, "film x traction power_loss");
    line_run(&b, "film x traction power_loss");
    size_t n = 129;
    check_near("film", line_value(&b, "film", 20 * n + 3), line_value(&a, "film", 20 * n + n - 4),
               0);
    check_near("position", line_value(&b, "x", 3), -line_value(&a, "x", n - 4), 0);
    check_near("traction", line_value(&b, "traction", 20), -line_value(&a, "traction", 20), 0);
    check_near("loss", line_value(&b, "power_loss", 20), line_value(&a, "power_loss", 20), 0);
    line_close(&a);
    line_close(&b);
}

/* Errors of the mean and of the highest Hertz pressure, from linear interpolation between 40 rows:
   1e-3. */
static void test_instants(void)
{
    static const size_t steps[] = {1, 2};
    const double missed[] = {sqrt(1.6) - 1, 2 * (0.3 / pi - 0.075) / 1.3};
    for (int i = 0; i < 2; i++) {
        line c;
        cycle(&c, 128, steps[i], "bdf2", 1e-4);
        line_run(&c, "h_min");
        check_near("missed between the instants", stage_quality(c.film, "instants"), missed[i],
                   i == 0 ? 1e-12 : 1.5e-2);
        check_true("which is doubtful", stage_verdict(c.film) == FF_DOUBTFUL);
        line_close(&c);
    }
}

static void test_stop(void)
{
    line c;
    cycle(&c, 128, 200, "bdf2", 1e-4);
    stage_stop_at(c.film, 3);
    check_true("stops when asked to", line_run(&c, "h_min") == FF_STOPPED);
    line_close(&c);
}

int main(void)
{
    test_balances();
    test_flow();
    test_order("euler", 1.7, 2.4);
    test_order("bdf2", 3.2, 5);
    test_grid();
    test_estimate("h_min", "h_min_error");
    test_estimate("h_central", "h_central_error");
    test_mirror();
    test_instants();
    test_stop();
    return check_done();
}
