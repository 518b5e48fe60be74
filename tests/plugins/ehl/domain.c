/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Checks that the default inlet changes the film by less than 0.1 % under every load, compared
 * with a longer domain with equal cells, and by at most the value in the quality record, within
 * a third. If the cells are too few for this inlet and a resolved film at all instants, a
 * shorter inlet begins with the pressure of the longer inlet. The default outlet must be long
 * enough for a contact that grows faster than the oil leaves; the quality record must report an
 * outlet that is too short.
 *
 *   test-ehl-domain [print]      print: as a table for the documentation
 */
#include "check.h"
#include "line.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double loads[] = {4, 1, 0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4};

enum { LOADS = sizeof loads / sizeof loads[0] };

typedef struct domain {
    double missing, stated, lengths; /* missing, stated: over the film thickness; lengths: inlet
                                        over sqrt(2 R h) */
} domain;

/* inlet 0: auto */
static double solve(double load, int isoviscous, double inlet, double outlet, size_t cells, line *c)
{
    line_open(c, "ehl/finite-volume");
    if (isoviscous)
        line_oil(c, "viscosity/isoviscous", 5.006e-3, 0);
    c->load[0] *= load;
    if (inlet > 0) {
        stage_set(c->film, "inlet", inlet);
        stage_set(c->film, "outlet", outlet);
    }
    stage_set(c->film, "cells", (double)cells);
    stage_set(c->film, "tolerance", 1e-9);
    if (line_run(c, "h_min x") != FF_OK)
        check_true(stage_why(c->film), 0);
    return line_value(c, "h_min", 0);
}

static domain measure(double load, int isoviscous)
{
    enum { CELLS = 512, FARTHER = 8 };
    line near, far;
    double h = solve(load, isoviscous, 0, 0, CELLS, &near);
    size_t nodes;
    const double *x = stage_get(near.film, "x", &nodes), pi = acos(-1);
    double dx = x[1] - x[0], a = sqrt(8 * near.load[0] * near.radius[0] / (pi * near.modulus));
    double more = FARTHER * CELLS * dx; /* in front of the domain */
    double whole = solve(load, isoviscous, (more - x[0]) / a, x[nodes - 1] / a,
                         (FARTHER + 1) * (size_t)CELLS, &far);
    domain d = {1 - h / whole, stage_quality(near.film, "starvation"),
                stage_quality(near.film, "inlet_length")};
    line_close(&near);
    line_close(&far);
    return d;
}

static void print(void)
{
    printf("| load over nominal load | inlet length | missing film | stated | isoviscous: inlet "
           "length "
           "| missing film | stated |\n|---|---|---|---|---|---|---|\n");
    for (int k = 0; k < LOADS; k++) {
        printf("| %g ", loads[k]);
        for (int isoviscous = 0; isoviscous < 2; isoviscous++) {
            domain d = measure(loads[k], isoviscous);
            printf("| %.1f | %.3f %% | %.3f %% ", d.lengths, 100 * d.missing, 100 * d.stated);
        }
        printf("|\n");
    }
}

/* A tooth of a pinion of 12 teeth that meshes with 60, m 3 mm, 1500 rpm: R grows from 1.17 mm at
   SAP to 9 mm at the tip, or back. Barus oil, two loads. inlet 0: auto. */
static void solve_tooth(line *c, int backwards, double inlet, double cells)
{
    enum { ROWS = 200 };
    line_open(c, "ehl/finite-volume");
    line_oil(c, "viscosity/barus", 60e-3, 12e-9);
    line_last(c, ROWS, 3e-3);
    for (int k = 0; k < ROWS; k++) {
        double s = (double)(backwards ? ROWS - 1 - k : k) / (ROWS - 1);
        c->radius[k] = 1.171e-3 + s * 7.8e-3;
        c->u1[k] = 0.2 + 3.2 * s;
        c->u2[k] = 1.2 + 0.5 * s;
        c->load[k] = s > 0.35 && s < 0.65 ? 88.7e3 : 44.3e3;
    }
    stage_set(c->film, "steps", 200);
    stage_set(c->film, "cells", cells);
    if (inlet > 0)
        stage_set(c->film, "inlet", inlet);
    check_true("runs", line_run(c, "h_min h_central x load_ahead") == FF_OK);
}

static double off_at(const line *c, const line *fine, size_t k)
{
    return fabs(line_value(c, "h_central", k) / line_value(fine, "h_central", k) - 1);
}

/* Checks load_ahead, the load of the oil in front of a short domain, at the first, steady instant,
   with the film on a longer domain. */
static void check_load_ahead(const line *tooth)
{
    line whole;
    size_t n;
    line_open(&whole, "ehl/finite-volume");
    line_oil(&whole, "viscosity/barus", 60e-3, 12e-9);
    whole.radius[0] = tooth->radius[0];
    whole.u1[0] = tooth->u1[0];
    whole.u2[0] = tooth->u2[0];
    whole.load[0] = tooth->load[0];
    stage_set(whole.film, "cells", 4096);
    stage_set(whole.film, "inlet", 100);
    check_true("runs", line_run(&whole, "x pressure") == FF_OK);
    const double *x = stage_get(whole.film, "x", &n), *p = stage_get(whole.film, "pressure", NULL);
    const double begin = stage_get(tooth->film, "x", NULL)[0], dx = x[1] - x[0];
    double carried = 0, ahead = line_value(tooth, "load_ahead", 0);
    for (size_t i = 0; i < n && x[i] < begin; i++)
        carried += p[i] * fmin(dx, dx / 2 + begin - x[i]);
    printf("in front %.3f N/mm, for %.3f\n", 1e-3 * ahead, 1e-3 * carried);
    check_below("the load in front", fabs(ahead / carried - 1), 0.05);
    line_close(&whole);
}

/* An inlet long enough for an error of 0.1 % at the tip leaves too few cells for the contact at
   SAP: with 512 cells, the film there would be 60 % too thin. A shorter inlet would make the film
   at the tip 2.3 % too thin if it did not begin with the pressure of a longer inlet. The radius R
   increases along the tooth, or decreases. */
static void test_both_ends(int backwards)
{
    const double inlet = 20, cells = 512;
    line few, fine;
    solve_tooth(&few, backwards, 0, cells);
    solve_tooth(&fine, backwards, inlet, 8 * cells);
    double first = off_at(&few, &fine, 0), last = off_at(&few, &fine, 200), worst = 0;
    for (size_t k = 0; k <= 200; k++)
        worst = fmax(worst, off_at(&few, &fine, k));
    if (backwards) /* at SAP, the domain begins too close to the contact */
        check_load_ahead(&few);
    printf("first %.4f, last %.4f, worst %.4f of the film\n", first, last, worst);
    check_below("at SAP", backwards ? last : first, 0.01);
    check_below("at the tip", backwards ? first : last, 2e-3);
    check_below("at any instant", worst, 0.01);
    double starvation = stage_quality(few.film, "starvation");
    check_below("starvation is told", backwards ? first : last, 1.5 * starvation);
    check_below("and no more", starvation, 5e-3);
    line_close(&few);
    line_close(&fine);
}

/* A load squeezes a film faster than the oil moves, and the contact draws in oil at the outlet.
   inlet, outlet 0: auto. Returns the film at x = 117 um, 0.8 of the half-width. */
static double drawn_in(double inlet, double outlet, double cells, double *told)
{
    static const double time[] = {0, 50e-6, 120e-6}, load[] = {2e3, 150e3, 150e3};
    line c;
    size_t n, rows;
    line_open(&c, "ehl/finite-volume");
    line_oil(&c, "viscosity/barus", 10e-3, 15e-9);
    line_last(&c, 3, 1);
    for (int k = 0; k < 3; k++) {
        c.time[k] = time[k];
        c.u1[k] = c.u2[k] = 0.05;
        c.load[k] = load[k];
    }
    stage_set(c.film, "cells", cells);
    if (inlet > 0) {
        stage_set(c.film, "inlet", inlet);
        stage_set(c.film, "outlet", outlet);
    }
    check_true("runs", line_run(&c, "x film") == FF_OK);
    const double *x = stage_get(c.film, "x", &n), *h = stage_get(c.film, "film", &rows);
    size_t i = 0;
    while (x[i + 1] < 117e-6)
        i++;
    h += rows - n;
    double film = h[i] + (117e-6 - x[i]) / (x[i + 1] - x[i]) * (h[i + 1] - h[i]);
    *told = stage_quality(c.film, "outlet_length");
    line_close(&c);
    return film;
}

static void test_swelling(void)
{
    double told[3], film[3] = {drawn_in(0, 0, 1024, &told[0]), drawn_in(2.4, 1.27, 1024, &told[1]),
                               drawn_in(2.4, 5, 2048, &told[2])};
    double off = 1 - film[0] / film[2], cut = 1 - film[1] / film[2];
    printf("swelling: %.4f of the film at the outlet left out (told %.3f), of a short outlet %.4f "
           "(%.3f)\n",
           off, told[0], cut, told[1]);
    check_below("of the film", fabs(off), 0.015);
    check_true("the outlet is long enough", told[0] >= 0.99 && told[2] > 1);
    check_true("a short one cuts it off, and is told", cut > 0.05 && told[1] < 0.7);
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "print") == 0) {
        print();
        return 0;
    }
    for (int k = 0; k < LOADS; k++)
        for (int isoviscous = 0; isoviscous < 2; isoviscous++) {
            domain d = measure(loads[k], isoviscous);
            char text[80];
            snprintf(text, sizeof text, "load x %g: %.1f lengths, film left out", loads[k],
                     d.lengths);
            check_below(text, d.missing, 1e-3);
            check_below("no more than stated", d.missing, 4. / 3 * d.stated);
        }
    test_both_ends(0);
    test_both_ends(1);
    test_swelling();
    return check_done();
}
