/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the default inlet leaves out of the film, at the same distance of the nodes: less than 0.1 %
 * of it under every load, and no more than the quality record says, within a third.
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
    double missing, stated, lengths; /* shares of the film; S = sqrt(2 R h) */
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
    printf(
        "| load over nominal | inlet, sqrt(2 R h) | film left out | as stated | isoviscous: inlet "
        "| film left out | as stated |\n|---|---|---|---|---|---|---|\n");
    for (int k = 0; k < LOADS; k++) {
        printf("| %g ", loads[k]);
        for (int isoviscous = 0; isoviscous < 2; isoviscous++) {
            domain d = measure(loads[k], isoviscous);
            printf("| %.1f | %.3f %% | %.3f %% ", d.lengths, 100 * d.missing, 100 * d.stated);
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
    for (int k = 0; k < LOADS; k++)
        for (int isoviscous = 0; isoviscous < 2; isoviscous++) {
            domain d = measure(loads[k], isoviscous);
            char text[80];
            snprintf(text, sizeof text, "load x %g: %.1f lengths, film left out", loads[k],
                     d.lengths);
            check_below(text, d.missing, 1e-3);
            check_below("no more than stated", d.missing, 4. / 3 * d.stated);
        }
    return check_done();
}
