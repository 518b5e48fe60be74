/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares ehl/inlet-analysis with ehl/finite-volume, in steady contacts and during an engagement
   of a tooth pair. */
#include "check.h"
#include "line.h"

#include <math.h>
#include <stdio.h>

enum { ROWS = 64 };

static void choose(line *c, const char *law, double M, double L)
{
    if (L > 0)
        line_moes(c, M, L);
    else
        line_moes_isoviscous(c, M);
    if (law)
        line_oil(c, law, c->eta0, 2.2e-8);
}

/* slide: slide-roll ratio; if not 0, the oil is Ree-Eyring. */
static void test_steady(const char *law, double M, double L, double slide)
{
    line full, quick, *each[] = {&full, &quick};
    char text[96];
    for (int k = 0; k < 2; k++) {
        line *c = each[k];
        line_open(c, k ? "ehl/inlet-analysis" : "ehl/finite-volume");
        choose(c, law, M, L);
        if (slide > 0)
            line_eyring(c, 5e6);
        c->u1[0] *= 1 + slide / 2;
        c->u2[0] *= 1 - slide / 2;
        stage_set(c->film, "cells", 1024);
        check_true("runs", line_run(c, "h_min h_central friction_coefficient") == FF_OK);
    }
    double h = line_value(&full, "h_central", 0), found = line_value(&quick, "h_central", 0);
    snprintf(text, sizeof text, "%s M %g L %g slide %g, h_central %+.1f %%", law ? law : "Roelands",
             M, L, slide, 100 * (found / h - 1));
    check_near(text, found, h, 0.1);
    h = line_value(&full, "h_min", 0);
    check_near("h_min", line_value(&quick, "h_min", 0), h, 0.12);
    check_near("inside the range", 1 + stage_quality(quick.film, "outside_range"), 1, 0);
    line_close(&full);
    line_close(&quick);
}

/* Operating point I of Li & Kahraman 2011, ROWS rows 0.2 deg apart: one third of the load
   at both ends, two thirds beside the single contact, and `swing` of a vibration. */
static void tooth_pass(line *c, double speed, double swing)
{
    const double degree = acos(-1) / 180, base = 70.476947e-3, sum = 51.3030e-3;
    const double sap = 14.537, tip = 27.171, spin = speed * 1500 * 6 * degree;
    c->count = ROWS;
    for (size_t i = 0; i < c->count; i++) {
        double roll = sap + (tip - sap) * (double)i / (ROWS - 1);
        double share = (1 + fmin(fmin(roll - sap, tip - roll) / (19.971 - sap), 1)) / 3;
        double r1 = base * roll * degree, r2 = sum - r1;
        if (roll > 19.971 && roll < 21.737)
            share = 1;
        c->time[i] = (roll - sap) * degree / spin;
        c->radius[i] = r1 * r2 / sum;
        c->u1[i] = spin * r1;
        c->u2[i] = spin * r2;
        c->load[i] = 177.363e3 * share * (1 + swing * sin(0.6 * (double)i));
    }
}

static void test_pass(double speed, double swing)
{
    enum { STEPS = 1000 };
    line full, quick, *each[] = {&full, &quick};
    double worst = 0, sum = 0;
    char text[96];
    for (int k = 0; k < 2; k++) {
        line_open(each[k], k ? "ehl/inlet-analysis" : "ehl/finite-volume");
        line_eyring(each[k], 5e6);
        tooth_pass(each[k], speed, swing);
        stage_set(each[k]->film, "steps", STEPS);
        check_true("runs", line_run(each[k], "h_min h_central") == FF_OK);
    }
    for (size_t i = 0; i <= STEPS; i++) {
        double off = line_value(&quick, "h_central", i) / line_value(&full, "h_central", i) - 1;
        worst = fabs(off) > fabs(worst) ? off : worst;
        sum += off * off;
    }
    snprintf(text, sizeof text,
             "pass at %g rpm, swing %g: h_central off by %.1f %% rms, worst %+.1f %%", 1500 * speed,
             swing, 100 * sqrt(sum / STEPS), 100 * worst);
    check_below(text, fabs(worst), 0.1);
    check_true("in range", stage_verdict(quick.film) == FF_GOOD);
    line_close(&full);
    line_close(&quick);
}

/* The film at the inlet must reach the middle unchanged, after the time a/u. */
static void test_transport(void)
{
    line c;
    line_open(&c, "ehl/inlet-analysis");
    line_last(&c, 3, 400e-6);
    c.u1[1] *= 1.3; /* the entrainment speed increases by 30 % from 100 us to 200 us */
    c.u1[2] *= 1.3;
    c.u2[1] *= 1.3;
    c.u2[2] *= 1.3;
    c.time[1] = 100e-6;
    c.time[2] = 400e-6;
    c.u1[1] = c.u1[0];
    c.u2[1] = c.u2[0];
    stage_set(c.film, "steps", 400);
    check_true("runs", line_run(&c, "h_central time") == FF_OK);
    double first = line_value(&c, "h_central", 0);
    /* a = 160 um, u = 4.03 m/s: 39.7 us */
    check_near("nothing arrives before", line_value(&c, "h_central", 138), first, 1e-5);
    check_true("then it does", line_value(&c, "h_central", 145) > 1.0005 * first);
    line_close(&c);
}

/* Under constant conditions, the film must stay steady. */
static void test_rest(void)
{
    line c;
    line_open(&c, "ehl/inlet-analysis");
    line_last(&c, 9, 300e-6);
    stage_set(c.film, "steps", 100);
    check_true("runs", line_run(&c, "h_min h_central") == FF_OK);
    double worst = 0;
    for (size_t k = 0; k <= 100; k++)
        worst = fmax(worst, fabs(line_value(&c, "h_min", k) / line_value(&c, "h_min", 0) - 1));
    check_below("a lasting contact rests", worst, 1e-5);
    line_close(&c);
}

static void test_outside(void)
{
    line c;
    line_open(&c, "ehl/inlet-analysis");
    line_moes(&c, 0.5, 5);
    check_true("runs", line_run(&c, "h_min h_min_error") == FF_OK);
    check_near("says that it is outside", stage_quality(c.film, "outside_range"), 1, 0);
    check_true("and is doubtful", stage_verdict(c.film) == FF_DOUBTFUL);
    check_near("all of it may be wrong", line_value(&c, "h_min_error", 0),
               line_value(&c, "h_min", 0), 1e-12);
    line_close(&c);
}

int main(void)
{
    static const double Ms[] = {2, 5, 20, 200};
    for (size_t i = 0; i < 4; i++) {
        test_steady(NULL, Ms[i], 5, 0);
        test_steady(NULL, Ms[i], 15, 0.3);
        test_steady("viscosity/barus", Ms[i], 10, 0);
        test_steady(NULL, Ms[i], 0, 0.2);
    }
    test_pass(1, 0);
    test_pass(1, 0.1);
    test_pass(1.9, 0);
    test_transport();
    test_rest();
    test_outside();
    return check_done();
}
