/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Central film of smooth steady contacts, by every model, against extrapolated solutions of an
 * independent program (dense Newton, penalty cavitation, Hertz scaling), in Moes' scale; the order
 * of convergence; and the consistency of compressible films with Moes 2000.
 *
 *   test-ehl-table [all|print]      all: every case; print: as tables for the documentation
 */
#include "check.h"
#include "models.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct row {
    double M, L; /* L = 0: isoviscous */
    char law;    /* c: compressible Roelands, i: incompressible, B: incompressible Barus */
    int always;
    double inlet, outlet, h_central, within; /* within: tolerance for 1024 cells */
} row;

static const row rows[] = {
    {5, 5, 'c', 1, 12, 2.5, 3.8753, 0.01},   {10, 5, 'c', 0, 8, 2, 3.4601, 0.01},
    {20, 5, 'c', 1, 4, 1.5, 3.0807, 0.01},   {50, 5, 'c', 1, 4, 1.5, 2.6407, 0.01},
    {20, 10, 'c', 0, 4, 1.5, 4.360, 0.01},   {50, 10, 'c', 0, 4, 1.5, 3.811, 0.01},
    {100, 10, 'c', 1, 4, 1.5, 3.4361, 0.01}, {200, 10, 'c', 0, 4, 1.5, 3.100, 0.01},
    {20, 5, 'i', 0, 4, 1.5, 3.4190, 0.01},   {20, 5, 'B', 1, 4, 1.5, 3.5004, 0.01},
    {20, 10, 'B', 0, 4, 1.5, 5.2636, 0.01},  {50, 10, 'B', 0, 4, 1.5, 4.7496, 0.01},
    {20, 0, 'i', 1, 6, 1.5, 1.4204, 0.01},   {50, 0, 'i', 0, 6, 1.5, 1.1593, 0.01},
    {100, 0, 'i', 1, 6, 1.5, 1.0016, 0.02},
};

enum { ROWS = sizeof rows / sizeof rows[0] };

/* Returns the film by Moes 2000, for an incompressible oil. */
static double moes(double M, double L)
{
    double ri = 3 / M, ei = 2.621 * pow(M, -0.2), rp = 1.287 * pow(L, 2. / 3),
           ep = 1.311 * pow(M, -0.125) * pow(L, 0.75), s = (7 + 8 * exp(-2 * ei / ri)) / 5;
    return pow(pow(pow(ri, 7. / 3) + pow(ei, 7. / 3), 3 * s / 7) +
                   pow(pow(rp, -3.5) + pow(ep, -3.5), -2 * s / 7),
               1 / s);
}

typedef struct result {
    double central, least; /* in Moes' dimensionless form */
    double density;        /* rho/rho0 at x = 0 */
    double error;          /* h_min_error over h_min */
    double resolved;       /* cells over the inlet's pressure rise */
} result;

/* Theory (12.3). */
static double cells_of_inlet(const line *c, double h_central, double dx)
{
    double R = c->radius[0], a = sqrt(8 * c->load[0] * R / (M_PI * c->modulus));
    double l = a * pow(3 * h_central * R / (2 * sqrt(2) * a * a), 2. / 3);
    return fmin(l, sqrt(2 * R * h_central)) / dx;
}

/* wedge: value of this parameter, or NULL if the model does not have it. */
static result solve(const film_model *m, const row *r, size_t cells, const char *wedge)
{
    line c;
    result out = {0};
    line_open(&c, m->id);
    if (r->L > 0)
        line_moes(&c, r->M, r->L);
    else
        line_moes_isoviscous(&c, r->M);
    if (r->law != 'c')
        line_incompressible(&c);
    if (r->law == 'B')
        line_oil(&c, "viscosity/barus", c.eta0, 2.2e-8);
    stage_set(c.film, "cells", (double)cells);
    if (m->solves) {
        stage_set(c.film, "inlet", r->inlet);
        stage_set(c.film, "outlet", r->outlet);
        stage_set_text(c.film, "wedge", wedge);
        stage_set(c.film, "tolerance", 1e-8);
    }
    ff_status status = line_run(&c, "h_min h_central h_min_error pressure x");
    if (status != FF_OK) {
        check_true(stage_why(c.film), 0);
        line_close(&c);
        return (result){NAN, NAN, NAN, NAN, 1e9};
    }
    size_t nodes, centre = 0;
    const double *x = stage_get(c.film, "x", &nodes), *p = stage_get(c.film, "pressure", NULL);
    for (size_t i = 0; i < nodes; i++)
        centre = fabs(x[i]) < fabs(x[centre]) ? i : centre;
    out.resolved = cells_of_inlet(&c, line_value(&c, "h_central", 0), x[1] - x[0]);
    out.density = 1 + 0.34 * p[centre] / (0.59e9 + p[centre]);
    out.central = line_moes_film(&c, line_value(&c, "h_central", 0));
    out.error = line_value(&c, "h_min_error", 0) / line_value(&c, "h_min", 0);
    out.least = line_moes_film(&c, line_value(&c, "h_min", 0));
    line_close(&c);
    return out;
}

static void title(char *text, size_t size, const film_model *m, const row *r)
{
    snprintf(text, size, "%s, M %g L %g %c", m->name, r->M, r->L, r->law);
}

static int is_dense(const film_model *m)
{
    return strstr(m->name, "dense") != NULL;
}

/* ehl/dense-newton takes too long on 1024 cells: it must agree with ehl/finite-volume on 256. */
static void test_row(const film_model *m, const row *r)
{
    char text[96];
    title(text, sizeof text, m, r);
    if (is_dense(m)) {
        double twin = solve(&film_models[2], r, 256, "second").central;
        check_near(text, solve(m, r, 256, "second").central, twin, 1e-6);
        return;
    }
    result fine = solve(m, r, 1024, "second");
    check_near(text, fine.central, r->h_central, m->solves ? r->within : m->central);
    if (r->law == 'c' && m->solves)
        check_near("consistent with Moes", fine.density * fine.central, moes(r->M, r->L), 0.025);
}

/* The order of convergence, from errors on three grids, of which the coarsest resolves the
   inlet. */
static void test_order(const film_model *m, const row *r, const char *wedge, double low,
                       double high)
{
    double h[3];
    char text[160];
    size_t cells = 128;
    result first;
    do {
        cells *= 2;
        first = solve(m, r, cells, wedge);
    } while (first.resolved < 8);
    h[0] = first.central;
    h[1] = solve(m, r, 2 * cells, wedge).central;
    h[2] = solve(m, r, 4 * cells, wedge).central;
    double ratio = (h[1] - h[0]) / (h[2] - h[1]);
    title(text, sizeof text, m, r);
    snprintf(text + strlen(text), sizeof text - strlen(text),
             ", %s-order wedge, from %zu cells: error falls %.2f times", wedge, cells, ratio);
    check_true(text, ratio > low && ratio < high);
}

/* The stated error of h_min on a coarse grid must be at least the difference to a fine grid. */
static void test_estimate(const film_model *m, const row *r)
{
    char text[120];
    result coarse = solve(m, r, 512, "second"), fine = solve(m, r, 4096, "second");
    double off = fabs(coarse.least / fine.least - 1);
    title(text, sizeof text, m, r);
    snprintf(text + strlen(text), sizeof text - strlen(text), ", 512 cells: error of h_min");
    check_below(text, off, coarse.error);
}

static const char *oil(const row *r)
{
    return r->law == 'c'   ? "Roelands"
           : r->law == 'B' ? "Barus, incompressible"
           : r->L > 0      ? "Roelands, incompressible"
                           : "isoviscous";
}

static void print_films(void)
{
    static const size_t grids[] = {256, 512, 1024, 2048};
    printf("| M | L | oil | reference | film-formula | inlet-analysis | model | cells: 256 | 512 | "
           "1024 | 2048 | order |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < ROWS; i++)
        for (int k = 0; k < FILM_MODELS; k++) {
            const film_model *m = &film_models[k];
            const row *r = &rows[i];
            double h[4] = {0}, ref = r->h_central;
            size_t count = is_dense(m) ? 2 : 4;
            if (!m->solves)
                continue;
            if (k == 2) {
                result f = solve(&film_models[0], r, 64, NULL),
                       a = solve(&film_models[1], r, 64, NULL);
                printf("| %g | %g | %s | %.4g | %.4g (%+.1f %%) | %.4g (%+.1f %%) ", r->M, r->L,
                       oil(r), ref, f.central, 100 * (f.central / ref - 1), a.central,
                       100 * (a.central / ref - 1));
            } else {
                printf("| | | | | | ");
            }
            printf("| %s ", m->name);
            for (size_t j = 0; j < count; j++) {
                h[j] = solve(m, r, grids[j], "second").central;
                printf("| %.4f (%+.2f %%) ", h[j], 100 * (h[j] / ref - 1));
            }
            double ratio = (h[2] - h[1]) / (h[3] - h[2]);
            if (count == 4 && ratio > 0)
                printf("| %.2f |\n", log2(ratio));
            else
                printf("%s|\n", count == 4 ? "| " : "| | | ");
        }
}

static void print_law(void)
{
    printf("\n| M | L | rho H_central/rho0, control-volume | finite-volume | Moes | difference |\n"
           "|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < ROWS; i++) {
        const row *r = &rows[i];
        if (r->law != 'c')
            continue;
        result a = solve(&film_models[2], r, 2048, "second"),
               b = solve(&film_models[3], r, 2048, "second");
        double A = a.density * a.central, B = b.density * b.central, law = moes(r->M, r->L);
        printf("| %g | %g | %.4f | %.4f | %.4f | %+.1f %% |\n", r->M, r->L, B, A, law,
               100 * (A / law - 1));
    }
}

int main(int argc, char **argv)
{
    int all = argc > 1 && !strcmp(argv[1], "all");
    if (argc > 1 && !strcmp(argv[1], "print")) {
        print_films();
        print_law();
        return 0;
    }
    for (int k = 0; k < FILM_MODELS; k++)
        for (size_t i = 0; i < ROWS; i++) {
            const film_model *m = &film_models[k];
            if (!all && !rows[i].always)
                continue;
            test_row(m, &rows[i]);
            if (!m->solves || is_dense(m))
                continue;
            test_order(m, &rows[i], "second", 3, 5);
            test_estimate(m, &rows[i]);
            if (all || i == 2)
                test_order(m, &rows[i], "first", 1.6, 2.6);
        }
    return check_done();
}
