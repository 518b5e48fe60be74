/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A cylinder so stiff that it does not deform, with an oil whose viscosity does not depend on
 * pressure: compares films with the exact solution for Reynolds' condition at the exit (Martin
 * 1916), in xi = x/sqrt(2 R h0), for inlets at xi = -2 to -20.
 *
 *   test-ehl-rigid [print]      print: as a table for the documentation
 */
#include "check.h"
#include "models.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct {
    double inlet, load, rupture; /* load: w h0/(eta u R) */
} exact[] = {
    {2, 2.89682, 0.44470}, {4, 4.23342, 0.47012}, {8, 4.71467, 0.47445}, {20, 4.86526, 0.47509}};

enum { INLETS = sizeof exact / sizeof exact[0] };

typedef struct rigid {
    double load, pressure, rupture;
    double traction; /* w sqrt(h0/(2 R))/(eta u_s) */
} rigid;

static rigid solve(const film_model *m, int k, size_t cells)
{
    const double eta = 0.03, h0 = 1e-6, pi = 3.14159265358979323846;
    rigid out = {NAN, NAN, NAN, NAN};
    line c;
    line_open(&c, m->id);
    line_oil(&c, "viscosity/isoviscous", eta, 0);
    line_incompressible(&c);
    double R = c.radius[0], u = c.u1[0], S = sqrt(2 * R * h0), slide = 0.1 * u;
    c.u1[0] += slide / 2;
    c.u2[0] -= slide / 2;
    c.modulus = 1e18;
    c.load[0] = exact[k].load * eta * u * R / h0;
    double a = sqrt(8 * c.load[0] * R / (pi * c.modulus));
    stage_set(c.film, "cells", (double)cells);
    stage_set(c.film, "inlet", exact[k].inlet * S / a);
    stage_set(c.film, "outlet", 2 * S / a);
    stage_set(c.film, "tolerance", 1e-8);
    ff_status status = line_run(&c, "h_min p_max traction pressure x");
    if (status != FF_OK)
        check_true(stage_why(c.film), 0);
    if (status == FF_OK) {
        double h = line_value(&c, "h_min", 0);
        size_t nodes, last = 0;
        const double *p = stage_get(c.film, "pressure", &nodes);
        for (size_t i = 0; i < nodes; i++)
            last = p[i] > 0 ? i : last;
        out.load = c.load[0] * h / (eta * u * R);
        out.pressure = line_value(&c, "p_max", 0) * pow(h, 1.5) / (eta * u * sqrt(R));
        out.traction = fabs(line_value(&c, "traction", 0)) * sqrt(h / (2 * R)) / (eta * slide);
        out.rupture = line_value(&c, "x", last) / sqrt(2 * R * h);
    }
    line_close(&c);
    return out;
}

static void print(void)
{
    printf("| model | cells | inlet xi -2: 2.89682 | -4: 4.23342 | -8: 4.71467 | -20: 4.86526 |\n"
           "|---|---|---|---|---|---|\n");
    for (int m = 0; m < FILM_MODELS; m++)
        for (size_t cells = 256; film_models[m].solves && cells <= 1024; cells *= 2) {
            if (cells > 256 && m == FILM_MODELS - 1)
                break;
            printf("| %s | %zu ", film_models[m].name, cells);
            for (int k = 0; k < INLETS; k++) {
                double load = solve(&film_models[m], k, cells).load;
                printf("| %.5f (%+.2f %%) ", load, 100 * (load / exact[k].load - 1));
            }
            printf("|\n");
        }
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "print") == 0) {
        print();
        return 0;
    }
    for (int m = 0; m < FILM_MODELS; m++)
        for (int k = 0; film_models[m].solves && k < INLETS; k++) {
            int dense = m == FILM_MODELS - 1;
            rigid r = solve(&film_models[m], k, dense ? 256 : 2048);
            double wider = dense ? 8 : 1; /* tolerance for an eighth of the cells */
            check_near("load number", r.load, exact[k].load, 2e-3 * wider);
            check_near("rupture", r.rupture, exact[k].rupture, 0.03 * wider);
            check_near("traction number", r.traction, atan(exact[k].inlet) + atan(exact[k].rupture),
                       5e-4 * wider); /* the inlet is a whole number of cells: 2e-3 for inlet 20 */
            if (k == INLETS - 1)
                check_near("pressure number", r.pressure, 2.150942, 2e-3 * wider);
        }
    return check_done();
}
