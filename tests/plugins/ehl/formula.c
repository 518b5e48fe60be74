/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ehl/film-formula: published values, the limits of Moes' formula, and its scatter against
   ehl/finite-volume. */
#include "../../../plugins/ehl/formula.h"

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

/* Printed with three digits: half of the last. */
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
    ff_contact_numbers n = {U, M * sqrt(two_u), L / pow(two_u, 0.25)};
    return ff_film_formula(FF_MOES, n).central / sqrt(two_u);
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

/* Rigid-isoviscous, elastic-isoviscous, rigid-piezoviscous, elastic-piezoviscous. */
static void test_moes_regimes(void)
{
    check_near("rigid, isoviscous", moes(1e-4, 0), 3 / 1e-4, 1e-3);
    check_near("elastic, isoviscous", moes(1e6, 0), 2.621 * pow(1e6, -0.2), 1e-3);
    check_near("rigid, piezoviscous", moes(3, 1e12), 1.287 * 1e8, 2e-3);
    check_near("elastic, piezoviscous", moes(1e9, 100), 1.311 * pow(1e9, -0.125) * pow(100, 0.75),
               1e-2);
}

static void solve(line *c, const char *model, const char *formula, double M, double L)
{
    line_open(c, model);
    if (L > 0)
        line_moes(c, M, L);
    else
        line_moes_isoviscous(c, M);
    if (formula)
        stage_set_text(c->film, "formula", formula);
    else
        stage_set(c->film, "cells", 1024);
    check_true(model,
               line_run(c, formula ? "h_min h_central h_min_error" : "h_min h_central") == FF_OK);
}

/* The stated error of h_min covers its distance from full solutions. Moes' central film: 10 %. */
static void test_scatter(void)
{
    static const char *const formula[] = {"moes", "dowson-higginson", "dowson-toyoda",
                                          "pan-hamrock"};
    static const double Ms[] = {2, 5, 20, 200}, Ls[] = {0, 2.5, 5, 15};
    char text[96];
    for (size_t i = 0; i < 4; i++)
        for (size_t j = 0; j < 4; j++) {
            line full, quick;
            solve(&full, "ehl/finite-volume", NULL, Ms[i], Ls[j]);
            double least = line_value(&full, "h_min", 0), mid = line_value(&full, "h_central", 0);
            for (size_t f = 0; f < (Ls[j] > 0 ? 4 : 1); f++) {
                solve(&quick, "ehl/film-formula", formula[f], Ms[i], Ls[j]);
                double h = line_value(&quick, "h_min", 0), hc = line_value(&quick, "h_central", 0);
                snprintf(text, sizeof text, "%s, M %g L %g: h_min %+.1f %%, h_central %+.1f %%",
                         formula[f], Ms[i], Ls[j], 100 * (h / least - 1), 100 * (hc / mid - 1));
                check_below(text, fabs(h - least), line_value(&quick, "h_min_error", 0));
                if (f == 0 && (Ls[j] > 0 || Ms[i] > 5))
                    check_near("central film by Moes", hc, mid, 0.1);
                line_close(&quick);
            }
            line_close(&full);
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

int main(void)
{
    test_examples();
    test_moes_spots();
    test_moes_regimes();
    test_scatter();
    test_isoviscous();
    test_coefficient();
    return check_done();
}
