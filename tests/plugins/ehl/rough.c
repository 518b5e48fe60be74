/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rough flanks in the contact: conserved quantities, balances, and flat flanks as the limit. */
#include "balance.h"
#include "check.h"
#include "flank.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static double mean(const line *c, const char *output)
{
    size_t n;
    const double *x = stage_get(c->film, output, &n);
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += x[i];
    return sum / (double)n;
}

/* The nodes move with the oil, but fields are output at fixed points: the extremes must not be lost
   between these points. */
static void check_fields(const char *what, const line *c)
{
    size_t times, all;
    const double *h_min = stage_get(c->film, "h_min", &times),
                 *h_central = stage_get(c->film, "h_central", NULL),
                 *p_max = stage_get(c->film, "p_max", NULL);
    const double *film = stage_get(c->film, "film", &all),
                 *p = stage_get(c->film, "pressure", NULL),
                 *asperity = stage_get(c->film, "asperity_pressure", NULL);
    char name[128];
    double off = 0, thin = HUGE_VAL;
    for (size_t k = 0, nodes = all / times; k < times; k++) {
        double least = HUGE_VAL, most = 0;
        for (size_t i = k * nodes; i < (k + 1) * nodes; i++) {
            least = fmin(least, film[i]);
            most = fmax(most, fmax(p[i], asperity[i]));
        }
        off = fmax(off, fmax(fabs(least / h_min[k] - 1), fabs(most / p_max[k] - 1)));
        thin = fmin(thin, h_central[k] / h_min[k]);
    }
    snprintf(name, sizeof name, "%s: h_min and p_max are those of the fields", what);
    check_true(name, off <= 0);
    snprintf(name, sizeof name, "%s: h_central is not below h_min", what);
    check_true(name, thin >= 1);
}

/* Opens a contact at the pitch point, for 1.5 passages of the oil. */
static void open_rough(line *c, const flank *f, double speed, double slide, size_t cells,
                       size_t steps)
{
    line_open(c, "ehl/finite-volume");
    line_eyring(c, 5e6);
    c->u1[0] *= speed * (1 + slide / 2);
    c->u2[0] *= speed * (1 - slide / 2);
    line_last(c, 2, 120e-6 / speed);
    stage_set(c->film, "cells", (double)cells);
    stage_set(c->film, "steps", (double)steps);
    flank_give(f, c->film);
}

/* Returns the largest difference of the asperities' load fraction, and of the load, from values
   computed from the fields. */
static double off_the_fields(const line *c)
{
    size_t count, n;
    const double *share = stage_get(c->film, "asperity_load_share", &count),
                 *x = stage_get(c->film, "x", &n),
                 *p = stage_get(c->film, "asperity_pressure", NULL);
    double worst = 0;
    for (size_t k = 0; k < count; k++) {
        double sum = 0;
        for (size_t i = 0; i < n; i++)
            sum += p[k * n + i] * (x[1] - x[0]);
        worst = fmax(worst, fmax(balance_load(c, k), fabs(sum / c->load[0] - share[k])));
    }
    return worst;
}

/* Checks a run, and returns the mean load fraction of the asperities. */
static double test_run(const char *what, double rq, double speed, double slide)
{
    double share = NAN;
    static flank f;
    char name[128];
    line c;
    flank_random(&f, 1, rq, 30e-6, 400e-6);
    open_rough(&c, &f, speed, slide, 256, 60);
    ff_status status = line_run(&c, "time x pressure film asperity_pressure h_min h_central p_max "
                                    "asperity_load_share load_ahead");
    snprintf(name, sizeof name, "%s runs %s", what, status == FF_OK ? "" : stage_why(c.film));
    if (check_true(name, status == FF_OK)) {
        share = mean(&c, "asperity_load_share");
        snprintf(name, sizeof name, "%s: load, and %.3g of it on asperities, against the fields",
                 what, share);
        check_below(name, off_the_fields(&c), 1e-9);
        check_fields(what, &c);
    }
    line_close(&c);
    return share;
}

static void test_flat(void)
{
    static flank f;
    double h[2];
    for (int k = 0; k < 2; k++) {
        line c;
        line_open(&c, "ehl/finite-volume");
        line_last(&c, 2, 40e-6);
        stage_set(c.film, "steps", 20);
        if (k == 0) {
            flank_random(&f, 1, 0, 30e-6, 400e-6);
            flank_give(&f, c.film);
        }
        line_run(&c, "h_central");
        h[k] = line_value(&c, "h_central", 20);
        line_close(&c);
    }
    check_near("flat flanks: the smooth film", h[0], h[1], 2e-3);
}

static void refused(const char *what, const char *item, flank *f)
{
    line c;
    open_rough(&c, f, 1, 0, 64, 2);
    check_true(what, line_run(&c, "h_min") == FF_INVALID && !strcmp(stage_why_item(c.film), item));
    line_close(&c);
}

static void test_refusals(void)
{
    static flank f;
    flank_sine(&f, 1e-7, 1e-4);
    f.position[7] *= 1.01;
    refused("uneven positions", "surface.position", &f);
    flank_sine(&f, 1e-7, 1e-4);
    f.height[0][9] = NAN;
    refused("a height that is no number", "surface.height_1", &f);
    flank_sine(&f, 1e-7, 1e-4);
    f.period *= 1.5;
    refused("a period that is not the record's", "surface.period", &f);
}

/* The film must contain the waves of at least 16 cells' length, or those that the parameter
   allows. */
static void test_cutoff(void)
{
    const double amplitude = 1e-7, length = 100e-6, cutoffs[] = {0, 150e-6, NAN};
    static flank f;
    flank_sine(&f, amplitude, length);
    for (size_t k = 0; k < 3; k++) {
        size_t n;
        line c;
        open_rough(&c, &f, 1, 0, 64, 1);
        line_last(&c, 2, 1e-6);
        if (isnan(cutoffs[k]))
            stage_set_text(c.film, "roughness_cutoff", "auto");
        else
            stage_set(c.film, "roughness_cutoff", cutoffs[k]);
        if (check_true("a cut-off", line_run(&c, "x h_min rq_left_out") == FF_OK)) {
            const double *x = stage_get(c.film, "x", &n);
            double cutoff = isnan(cutoffs[k]) ? 16 * (x[1] - x[0]) : cutoffs[k];
            double off = amplitude / sqrt(2) * (1 - exp2(-pow(cutoff / length, 2)));
            check_near("Rq left out", stage_scalar(c.film, "rq_left_out"), off, 1e-6);
            if (cutoff > 0)
                check_near("its share", stage_quality(c.film, "roughness_left_out"), off / f.rq[0],
                           1e-6);
        }
        line_close(&c);
    }
}

/* Flank 1 moves 4.6 um in 1 us, but its record ends after a quarter of this distance. */
static void test_short_record(void)
{
    static flank f;
    line c;
    flank_sine(&f, 1e-7, 1e-4);
    f.period = 0;
    open_rough(&c, &f, 1, 0.3, 64, 1);
    line_last(&c, 2, 1e-6);
    f.origin = 0.25e-6 * c.u1[0];
    flank_give(&f, c.film);
    if (check_true("a record that ends", line_run(&c, "h_min") == FF_OK))
        check_near("told", stage_quality(c.film, "surface_record"), 0.75, 1e-6);
    line_close(&c);
}

/* The domain must grow if asperities would touch the other flank at its ends. */
static void test_domain(void)
{
    static flank f;
    double length[2];
    for (int k = 0; k < 2; k++) {
        line c;
        flank_random(&f, 1, k ? 2e-6 : 0, 30e-6, 400e-6);
        open_rough(&c, &f, 1, 0, 64, 1);
        line_last(&c, 2, 1e-6);
        check_true("a short history", line_run(&c, "x h_min") == FF_OK);
        length[k] = stage_get(c.film, "x", NULL)[64];
        double beyond = sqrt(8 * c.radius[0] * f.rq[0] * sqrt(2));
        if (k)
            check_true("Rq 2 um: the outlet lies behind the asperities' reach", length[k] > beyond);
        line_close(&c);
    }
    check_true("the domain grows with Rq", length[1] > 1.2 * length[0]);
}

/* At the first instant, roughness is applied in full up to 1.5 a (0.24 mm) downstream of the
   contact, and decreases to 0 at 2 a. Under a light load, a crest between both comes closest to the
   other flank: the film must fit the reduced height there, and the height must keep growing as the
   flank moves. At the next instant, 4 um later, a height of 9 um changes by 9 um 1.5 (4/80), and
   the gap by this much or less. */
static void test_first_instant(void)
{
    const double crest = 0.38e-3;
    static flank f;
    line c;
    flank_sine(&f, 4.5e-6, 1e-3);
    f.origin = 0.25e-3 - crest;
    open_rough(&c, &f, 1, 0, 128, 2);
    line_last(&c, 3, 2e-6);
    c.load[0] *= 0.1; /* a follows from the last load, the largest */
    c.load[1] *= 0.1;
    if (check_true("a crest behind a light load", line_run(&c, "x film h_min") == FF_OK)) {
        size_t n, least = 0;
        const double *x = stage_get(c.film, "x", &n), *h = stage_get(c.film, "film", NULL);
        for (size_t i = 1; i < n; i++)
            least = h[i] < h[least] ? i : least;
        check_true("it comes closest", x[least] > 0.24e-3 && x[least] < 0.32e-3);
        check_below("heights at the first instant", stage_quality(c.film, "film_shape"), 1e-9);
        double most = 0;
        for (size_t i = 0; i < n; i++)
            most = fmax(most, fabs(h[n + i] - h[i]));
        check_below("the gap does not jump from there", most, 0.7e-6);
    }
    line_close(&c);
}

int main(void)
{
    test_domain();
    test_cutoff();
    test_short_record();
    test_first_instant();
    test_flat();
    test_refusals();
    double share = test_run("nominal speed", 0.5e-6, 1, 0.3);
    double slow = test_run("a tenth", 0.5e-6, 0.1, 0.3);
    test_run("pure rolling", 0.5e-6, 1, 0);
    test_run("one flank at rest", 0.5e-6, 1, 2);
    test_run("the other at rest", 0.5e-6, 1, -2);
    double coarse = test_run("Rq 2 um", 2e-6, 1, 0.3);
    check_true("slower flanks touch more", slow > 5 * share);
    check_true("rougher flanks touch more", coarse > 5 * slow);
    return check_done();
}
