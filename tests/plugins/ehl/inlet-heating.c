/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The quality line inlet_heating, the effect of heat that an isothermal film neglects. */
#include "../../../plugins/ehl/estimates/inlet.h"
#include "check.h"

#include "line.h"

#include <math.h>

static void test_factor(void)
{
    /* by hand: [1 - 13.2 * 0.003 * 0.1^0.42]/[1 + 0.213 (1 + 2.23 * 0.5^0.83) 0.1^0.64] */
    check_near("Gupta's factor", ehl_gupta_factor(0.6e9, 200e9, 0.1, 0.5), 0.8873321956, 1e-9);
    check_near("no heat, no loss", ehl_gupta_factor(1e9, 200e9, 0, 1), 1, 0);
    check_true("sliding heats",
               ehl_gupta_factor(1e9, 2e11, 0.1, 0.5) < ehl_gupta_factor(1e9, 2e11, 0.1, 0.1));
    check_true("so does load",
               ehl_gupta_factor(2e9, 2e11, 0.1, 0.5) < ehl_gupta_factor(1e9, 2e11, 0.1, 0.5));
    check_true("never below 0", !(ehl_gupta_factor(4e9, 2e11, 1e6, 1) < 0));
    check_true("a number at its limit", isfinite(ehl_gupta_factor(1e40, 1e-3, 1e300, 1e300)));
}

/* Returns the fraction of the film lost by heating at the pitch point of the gear pair of Li &
   Kahraman 2011. */
static double lost(const char *model, const char *param, double value)
{
    line c;
    line_open(&c, model);
    stage_set(c.film, "cells", 64);
    if (param)
        stage_set(c.film, param, value);
    check_true(model, line_run(&c, "h_min") == FF_OK);
    double share = stage_quality(c.film, "inlet_heating");
    line_close(&c);
    return share;
}

static void test_models(void)
{
    static const char *const models[] = {"ehl/finite-volume", "ehl/film-formula",
                                         "ehl/inlet-analysis"};
    line c;
    line_open(&c, models[0]);
    double u = (c.u1[0] + c.u2[0]) / 2, slide = fabs(c.u1[0] - c.u2[0]) / u;
    double p = sqrt(c.load[0] * c.modulus / (2 * M_PI * c.radius[0]));
    double expected = 1 - ehl_gupta_factor(p, c.modulus, c.eta0 * 0.03 * u * u / 0.14, slide);
    double twice = 1 - ehl_gupta_factor(p, c.modulus, c.eta0 * 0.06 * u * u / 0.14, slide);
    line_close(&c);
    check_true("some per cent", expected > 0.02 && expected < 0.1);
    for (int i = 0; i < 3; i++) {
        check_near("lost", lost(models[i], NULL, 0), expected, 1e-9);
        check_near("twice the slope", lost(models[i], "temperature_slope", 0.06), twice, 1e-9);
        check_near("half the conductivity", lost(models[i], "oil_conductivity", 0.07), twice, 1e-9);
    }
}

int main(void)
{
    test_factor();
    test_models();
    return check_done();
}
