/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steady films far from the nominal contact, with every law, solved without an earlier film: checks
   whether each satisfies its equations (balance.h). */
#include "balance.h"
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void choose_oil(line *c, int law)
{
    if (law == 1)
        line_oil(c, "viscosity/barus", 5.006e-3, 11.03e-9);
    if (law == 2)
        line_oil(c, "viscosity/isoviscous", 5.006e-3, 0);
    if (law == 3) {
        line_oil(c, "viscosity/doolittle-tait", 5.006e-3, 0);
        stage_set(c->oil, "B", 3.7303);
        stage_set(c->oil, "V_occ", 0.6132);
        stage_set(c->oil, "K0", 1.05e9);
        stage_set(c->oil, "K0_prime", 10.076);
    }
}

static void test_case(int law, double load, double speed, size_t cells)
{
    static const char *name[] = {"Roelands", "Barus", "isoviscous", "Doolittle-Tait"};
    char text[160];
    line c;
    line_open(&c, "ehl/finite-volume");
    choose_oil(&c, law);
    if (law > 0)
        line_eyring(&c, 5e6);
    c.load[0] *= load;
    c.u1[0] *= 1.2 * speed;
    c.u2[0] *= 0.8 * speed;
    stage_set(c.film, "cells", (double)cells);
    ff_status status = line_run(&c, "h_min film pressure x load_ahead");
    snprintf(text, sizeof text, "%s, load x %g, speed x %g: %s", name[law], load, speed,
             status == FF_OK ? "load and deflection" : stage_why(c.film));
    if (check_true(text, status == FF_OK && line_value(&c, "h_min", 0) > 0)) {
        check_below(text, balance_of_instants(&c, 1), 1e-9);
        /* the difference is 0.1 (heavy loads) to 2 (rigid flanks) times the square of the relative
           cell size */
        check_below("flow, over what differences of second order leave",
                    balance_flow(&c) * pow(balance_cells(&c), 2), 2.2);
    }
    line_close(&c);
}

/* If no film exists on a grid, the model must fail with a message. */
static void test_too_coarse(void)
{
    line c;
    line_open(&c, "ehl/finite-volume");
    c.load[0] *= 100;
    stage_set(c.film, "cells", 32);
    check_true("too coarse a grid", line_run(&c, "h_min") == FF_NOCONV &&
                                        strstr(stage_why(c.film), "at time 0 s") != NULL);
    line_close(&c);
}

int main(void)
{
    static const double load[] = {1e-6, 1e-3, 0.03, 1, 10}, speed[] = {0.1, 1, 100};
    for (int law = 0; law < 4; law++)
        for (size_t i = 0; i < 5; i++)
            for (size_t k = 0; k < 3; k++)
                test_case(law, load[i], speed[k], 512);
    test_case(3, 1, 0.01, 512);
    test_case(0, 1, 0.01, 512);
    test_case(0, 30, 1, 1024);
    test_case(0, 1, 1, 64);
    test_case(3, 10, 1, 256);
    test_too_coarse();
    return check_done();
}
