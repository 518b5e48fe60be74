/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Errors of films that are told by a second film on half the cells and steps, against the same
 * histories on four times as many of both: with heat, of volumes at first order, of volumes that
 * may be cavitated, and of oil that nearly comes to rest.
 */
#include "check.h"
#include "line.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { FINER = 4, MOST = 512 };

/* A bar over its estimate. */
static const double CAUTION = 1.5;

static const char outputs[] = "time h_min h_central h_min_error h_central_error";

/* The load swings by a third in two passages. */
static void swing(line *c, const char *model, double finer)
{
    enum { ROWS = 81 };
    line_open(c, model);
    line_last(c, ROWS, 160e-6);
    for (int k = 0; k < ROWS; k++)
        c->load[k] *= 1 + 0.3 * sin(2 * M_PI * c->time[k] / 80e-6);
    stage_set(c->film, "cells", 256 * finer);
    stage_set(c->film, "steps", 160 * finer);
    stage_set(c->film, "inlet", 4);
    stage_set(c->film, "outlet", 1.6);
}

static void heated(line *c, double finer)
{
    swing(c, "ehl/finite-volume", finer);
    line_grade(c, "ISO VG 100", 353.15);
    stage_set_text(c->film, "thermal", "full");
}

static void first_order(line *c, double finer)
{
    swing(c, "ehl/control-volume", finer);
    stage_set_text(c->film, "wedge", "first");
}

static void conserving(line *c, double finer)
{
    swing(c, "ehl/control-volume", finer);
    stage_set_text(c->film, "cavitation", "mass-conserving");
}

static void resting(line *c, double finer)
{
    swing(c, "ehl/finite-volume", finer);
    for (size_t k = 40; k < c->count; k++) {
        c->u1[k] *= fmax(0.05, 1 - 0.05 * (double)(k - 40));
        c->u2[k] *= fmax(0.05, 1 - 0.05 * (double)(k - 40));
    }
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Errors that are told are held by their bars at 95 % of the instants. Half of the bars of
 * h_central are at most `most` times the error. */
static void check_film(const char *what, void (*open)(line *c, double finer), double most)
{
    static const char *const films[] = {"h_min", "h_central"}, *const errors[] = {
                                                                   "h_min_error",
                                                                   "h_central_error"};
    line c, fine;
    size_t n;
    open(&c, 1);
    open(&fine, FINER);
    check_true("runs", line_run(&c, outputs) == FF_OK && line_run(&fine, outputs) == FF_OK);
    const double *t = stage_get(c.film, "time", &n);
    for (int k = 0; k < 2; k++) {
        double ratio[MOST];
        size_t held = 0;
        for (size_t i = 0; i < n && i < MOST; i++) {
            double h = line_value(&c, films[k], i), bar = line_value(&c, errors[k], i);
            double error = fabs(h - line_at(&fine, films[k], t[i]));
            ratio[i] = bar / CAUTION / fmax(error, 2e-5 * h);
            held += bar >= error && isfinite(bar);
        }
        qsort(ratio, n, sizeof *ratio, by_size);
        printf("%s, %s: held at %.3f, estimate over error %.2f, %.2f, %.2f\n", what, films[k],
               (double)held / (double)n, ratio[n / 10], ratio[n / 2], ratio[n - 1 - n / 10]);
        check_below("instants that no bar holds", 1 - (double)held / (double)n, 0.05);
        if (k == 1)
            check_below("estimate over error", ratio[n / 2], most);
    }
    line_close(&c);
    line_close(&fine);
}

int main(void)
{
    check_film("heat", heated, 3.2);
    check_film("first order", first_order, 2.5);
    check_film("volumes", conserving, 2.5);
    check_film("rest", resting, 2.5);
    return check_done();
}
