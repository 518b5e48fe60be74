/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * ehl/film-formula: published values, the limits of Moes' formula, and the scatter of all formulas
 * against ehl/finite-volume.
 *
 *   test-ehl-formula [print]      print: the scatter as a table for the documentation
 */
#include "../../../plugins/ehl/estimates/formula.h"
#include "check.h"

#include "line.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Contacts of Li & Kahraman 2011: eta0 5.006 mPa s, alpha 11.03 1/GPa, E' 226.4 GPa. */
typedef struct worked {
    double radius, load, speed;                                /* mm, N/mm, m/s */
    double dowson_higginson, pan_hamrock, dowson_toyoda, moes; /* um */
} worked;

static const worked examples[] = {
    {11.649, 59.1, 4.0293, 0.140, 0.129, 0.178, 0.183},
    {12.826, 177.363, 4.0293, 0.127, 0.117, 0.165, 0.167},
    {12.826, 177.363, 6.7209, 0.181, 0.167, 0.236, 0.237},
    {12.826, 177.363, 7.6557, 0.199, 0.182, 0.258, 0.259},
};

static double film_of(const worked *w, const char *formula, const char *output)
{
    line c;
    line_open(&c, "ehl/film-formula");
    line_oil(&c, "viscosity/barus", 5.006e-3, 11.03e-9);
    line_incompressible(&c);
    stage_set_text(c.film, "formula", formula);
    c.radius[0] = 1e-3 * w->radius;
    c.load[0] = 1e3 * w->load;
    c.u1[0] = c.u2[0] = w->speed;
    check_true(formula, line_run(&c, output) == FF_OK);
    double h = 1e6 * line_value(&c, output, 0);
    line_close(&c);
    return h;
}

/* The published values have three digits: the tolerance is half a unit of the last digit. */
static void test_examples(void)
{
    const double half = 0.00055;
    for (size_t k = 0; k < sizeof examples / sizeof examples[0]; k++) {
        const worked *w = &examples[k];
        check_below("h_min", fabs(film_of(w, "dowson-higginson", "h_min") - w->dowson_higginson),
                    half);
        check_below("h_min", fabs(film_of(w, "pan-hamrock", "h_min") - w->pan_hamrock), half);
        check_below("h_central", fabs(film_of(w, "dowson-toyoda", "h_central") - w->dowson_toyoda),
                    half);
        check_below("h_central", fabs(film_of(w, "moes", "h_central") - w->moes), half);
    }
}

static double moes(double M, double L)
{
    const double U = 1e-11, two_u = 2 * U;
    ehl_contact_numbers n = {U, M * sqrt(two_u), L / pow(two_u, 0.25)};
    return ehl_film_formula(EHL_MOES, n).central / sqrt(two_u);
}

static void test_moes_spots(void)
{
    static const double spot[][3] = {
        {5, 5, 4.10506},   {10, 5, 3.76749},  {20, 5, 3.46629},   {50, 5, 3.10045},
        {20, 10, 5.10053}, {50, 10, 4.63611}, {100, 10, 4.29681}, {200, 10, 3.97047},
        {20, 0, 1.44281},  {50, 0, 1.19907},  {100, 0, 1.04355},
    };
    for (size_t k = 0; k < sizeof spot / sizeof spot[0]; k++)
        check_near("Moes", moes(spot[k][0], spot[k][1]), spot[k][2], 5e-6);
}

/* The limits of Moes' formula: rigid-isoviscous, elastic-isoviscous, rigid-piezoviscous and
   elastic-piezoviscous. */
static void test_moes_regimes(void)
{
    check_near("rigid, isoviscous", moes(1e-4, 0), 3 / 1e-4, 1e-3);
    check_near("elastic, isoviscous", moes(1e6, 0), 2.621 * pow(1e6, -0.2), 1e-3);
    check_near("rigid, piezoviscous", moes(3, 1e12), 1.287 * 1e8, 2e-3);
    check_near("elastic, piezoviscous", moes(1e9, 100), 1.311 * pow(1e9, -0.125) * pow(100, 0.75),
               1e-2);
}

/* barus: incompressible, with Barus' law; else compressible with Roelands'. */
static void solve(line *c, const char *formula, int barus, double M, double L)
{
    line_open(c, formula ? "ehl/film-formula" : "ehl/finite-volume");
    if (L > 0)
        line_moes(c, M, L);
    else
        line_moes_isoviscous(c, M);
    if (barus) {
        line_oil(c, "viscosity/barus", c->eta0, 2.2e-8);
        line_incompressible(c);
    }
    if (formula)
        stage_set_text(c->film, "formula", formula);
    else
        stage_set(c->film, "cells", 1024);
    ff_status status = line_run(c, formula ? "h_min h_central h_min_error" : "h_min h_central");
    if (status != FF_OK)
        check_true(stage_why(c->film), 0);
}

static const char *const formulas[] = {"moes", "dowson-higginson", "dowson-toyoda", "pan-hamrock"};

enum { FORMULAS = 4 };

/* Relative differences of every formula from a full solution for a contact. */
typedef struct distance {
    double least, central, stated_least, stated_central;
} distance;

static void compare(int barus, double M, double L, distance d[FORMULAS])
{
    line full, quick;
    solve(&full, NULL, barus, M, L);
    double least = line_value(&full, "h_min", 0), central = line_value(&full, "h_central", 0);
    for (size_t f = 0; f < (L > 0 ? FORMULAS : 1); f++) {
        solve(&quick, formulas[f], barus, M, L);
        double h = line_value(&quick, "h_min", 0);
        d[f] = (distance){h / least - 1, line_value(&quick, "h_central", 0) / central - 1,
                          line_value(&quick, "h_min_error", 0) / h,
                          stage_quality(quick.film, "h_central_scatter")};
        line_close(&quick);
    }
    line_close(&full);
}

/* The difference from full solutions must be within the scatter that the model states. */
static void test_scatter(void)
{
    static const double Ms[] = {2, 5, 20, 200}, Ls[] = {0, 2.5, 5, 15};
    char text[120];
    for (int barus = 0; barus < 2; barus++)
        for (size_t i = 0; i < 4; i++)
            for (size_t j = (size_t)barus; j < 4; j++) {
                distance d[FORMULAS];
                compare(barus, Ms[i], Ls[j], d);
                for (size_t f = 0; f < (Ls[j] > 0 ? FORMULAS : 1); f++) {
                    snprintf(text, sizeof text, "%s, %s, M %g L %g: h_min %+.1f %%", formulas[f],
                             barus ? "Barus" : "Roelands", Ms[i], Ls[j], 100 * d[f].least);
                    check_below(text, fabs(d[f].least), d[f].stated_least);
                    snprintf(text, sizeof text, "h_central %+.1f %%", 100 * d[f].central);
                    if (f == 0 || (Ms[i] >= 5 && Ls[j] >= 5))
                        check_below(text, fabs(d[f].central), d[f].stated_central);
                }
                if (Ls[j] > 0)
                    check_below("with L > 0 Moes' central film", fabs(d[0].central), 0.08);
            }
}

/* Prints the largest difference of each formula over M and L, as a table for the documentation. */
static void print_scatter(void)
{
    static const double Ms[] = {2, 3, 5, 10, 20, 50, 100, 200}, Ls[] = {0, 1, 2.5, 5, 10, 15};
    static const struct {
        size_t formula, M_from, L_from, L_to;
        const char *where;
    } part[] = {
        {0, 0, 0, 0, "M 2 to 200, L 0"},       {0, 0, 1, 5, "M 2 to 200, L 1 to 15"},
        {1, 2, 3, 5, "M 5 to 200, L 5 to 15"}, {2, 2, 3, 5, "M 5 to 200, L 5 to 15"},
        {3, 2, 3, 5, "M 5 to 200, L 5 to 15"},
    };
    static distance all[2][8][6][FORMULAS];
    for (int barus = 0; barus < 2; barus++)
        for (size_t i = 0; i < 8; i++)
            for (size_t j = (size_t)barus; j < 6; j++)
                compare(barus, Ms[i], Ls[j], all[barus][i][j]);
    printf("| formula | range | h_min | h_central |\n|---|---|---|---|\n");
    for (size_t k = 0; k < sizeof part / sizeof part[0]; k++) {
        distance low = {HUGE_VAL, HUGE_VAL, 0, 0}, high = {-HUGE_VAL, -HUGE_VAL, 0, 0};
        for (int barus = 0; barus < 2; barus++)
            for (size_t i = part[k].M_from; i < 8; i++)
                for (size_t j = part[k].L_from; j <= part[k].L_to; j++) {
                    const distance *d = &all[barus][i][j][part[k].formula];
                    if (barus && j == 0)
                        continue;
                    low.least = fmin(low.least, d->least);
                    low.central = fmin(low.central, d->central);
                    high.least = fmax(high.least, d->least);
                    high.central = fmax(high.central, d->central);
                }
        printf("| %s | %s | %+.1f ... %+.1f %% | %+.1f ... %+.1f %% |\n", formulas[part[k].formula],
               part[k].where, 100 * low.least, 100 * high.least, 100 * low.central,
               100 * high.central);
    }
}

static void test_isoviscous(void)
{
    line c;
    line_open(&c, "ehl/film-formula");
    line_moes_isoviscous(&c, 20);
    stage_set_text(c.film, "formula", "pan-hamrock");
    check_true("a power of alpha needs one",
               line_run(&c, "h_min") == FF_INVALID && !strcmp(stage_why_item(c.film), "formula"));
    line_close(&c);
}

static void test_coefficient(void)
{
    line c;
    line_open(&c, "ehl/film-formula");
    line_oil(&c, "viscosity/barus", 5e-3, 20e-9);
    stage_set_text(c.film, "pressure_coefficient", "ambient");
    check_true("runs", line_run(&c, "h_central") == FF_OK);
    double ambient = line_value(&c, "h_central", 0);
    line_close(&c);
    line_open(&c, "ehl/film-formula");
    line_oil(&c, "viscosity/barus", 5e-3, 20e-9);
    check_true("runs", line_run(&c, "h_central") == FF_OK);
    check_near("Barus has one coefficient", line_value(&c, "h_central", 0), ambient, 1e-12);
    line_close(&c);
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "print") == 0) {
        print_scatter();
        return 0;
    }
    test_examples();
    test_moes_spots();
    test_moes_regimes();
    test_scatter();
    test_isoviscous();
    test_coefficient();
    return check_done();
}
