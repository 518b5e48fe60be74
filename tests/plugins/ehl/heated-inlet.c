/* SPDX-License-Identifier: GPL-3.0-or-later */
/* thermal: inlet in every model of the film. */
#include "../../../plugins/ehl/estimates/channel.h"
#include "check.h"

#include "line.h"

#include <math.h>
#include <string.h>

/* Opens a contact whose film heats itself: 0.1 Pa s, 10 m/s, slide-roll ratio 0.2. */
static void open_hot(line *c, const char *model, const char *thermal)
{
    line_open(c, model);
    line_grade(c, "ISO VG 320", 333.15);
    stage_set_text(c->film, "thermal", thermal);
    c->u1[0] = 11;
    c->u2[0] = 9;
}

static double central(const char *model, const char *thermal, double cells)
{
    line c;
    open_hot(&c, model, thermal);
    stage_set(c.film, "cells", cells);
    check_true(model, line_run(&c, "h_min h_central") == FF_OK);
    double h = line_value(&c, "h_central", 0);
    line_close(&c);
    return h;
}

/* ehl/inlet-analysis, which shares only the table with the full solution, must have films, and
   losses of film by heat, within 10 % of the full solution. */
static void test_factors(void)
{
    double of[3];
    static const char *const models[] = {"ehl/finite-volume", "ehl/inlet-analysis",
                                         "ehl/film-formula"};
    for (int i = 0; i < 3; i++)
        of[i] = central(models[i], "inlet", 1024) / central(models[i], "none", 1024);
    check_true("the heat takes a tenth and more off", of[0] < 0.9 && of[0] > 0.5);
    check_near("by the analysis of the inlet", of[1], of[0], 0.1);
    check_near("the formula takes it from there", of[2], of[1], 0.02);
}

/* Two solvers of the same equations must have the same film. */
static void test_twins(void)
{
    double h = central("ehl/finite-volume", "inlet", 256);
    check_near("by a dense Jacobian", central("ehl/dense-newton", "inlet", 256), h, 1e-4);
}

/* The error must be of second order in the cell size, although R is computed at some nodes only. */
static void test_order(void)
{
    double h1 = central("ehl/finite-volume", "inlet", 1024),
           h2 = central("ehl/finite-volume", "inlet", 2048),
           h3 = central("ehl/finite-volume", "inlet", 4096);
    check_true("the error falls by 3 or more", fabs(h1 - h2) > 3 * fabs(h2 - h3));
}

/* With little heat and no sliding, R = 1 - (3/7) F, and h is about proportional to R^0.7 in the
   inlet. The decrease of the film is then proportional to beta/k. */
static double lost_at(const char *model, double speed)
{
    double h[2];
    for (int i = 0; i < 2; i++) {
        line c;
        open_hot(&c, model, i ? "inlet" : "none");
        c.u1[0] = c.u2[0] = speed;
        check_true(model, line_run(&c, "h_central") == FF_OK);
        h[i] = line_value(&c, "h_central", 0);
        line_close(&c);
    }
    return 1 - h[1] / h[0];
}

static void test_little_heat(void)
{
    double one = lost_at("ehl/inlet-analysis", 0.4), two = lost_at("ehl/inlet-analysis", 0.8);
    check_true("as the square of the speed", two / one > 3.3 && two / one < 4.2);
}

/* Under constant conditions, the film must stay steady to 1e-4, the tolerance of the heat
   iteration, and satisfy the balances. */
static void test_time(void)
{
    line c;
    open_hot(&c, "ehl/finite-volume", "inlet");
    stage_set(c.film, "cells", 512);
    stage_set(c.film, "steps", 20);
    line_last(&c, 2, 1e-3);
    check_true("runs", line_run(&c, "h_min h_central power_loss mass_error") == FF_OK);
    double first = line_value(&c, "h_central", 0);
    check_near("stays", line_value(&c, "h_central", 20), first, 1e-4);
    check_below("energy of the flow", stage_quality(c.film, "energy_balance"),
                stage_quality_limit(c.film, "energy_balance"));
    check_true("R in the record", stage_quality(c.film, "inlet_heat") < 0.9);
    line_close(&c);
}

/* Opens a contact with an oil measured at one temperature, whose viscosity at other temperatures is
   not known. */
static void open_one_temperature(line *c, const char *model, const char *thermal)
{
    open_hot(c, model, thermal);
    stage_close(c->liquid);
    c->liquid = stage_open("lubricant/measured");
    stage_set(c->liquid, "eta0", 0.1);
    stage_set(c->liquid, "at", 333.15);
    stage_set(c->liquid, "density", 850);
    stage_set(c->liquid, "alpha", 20e-9);
    stage_set(c->liquid, "conductivity", 0.14);
    stage_set(c->liquid, "heat_capacity", 2000);
    stage_set(c->liquid, "temperature", 333.15);
    check_true("the oil is one", stage_run(c->liquid) == FF_OK);
    stage_link(c->oil, "oil", c->liquid);
    stage_link(c->rho, "oil", c->liquid);
}

static void test_refusals(void)
{
    line c;
    line_open(&c, "ehl/finite-volume");
    stage_set_text(c.film, "thermal", "inlet");
    check_true("no oil", line_run(&c, "h_min") == FF_INVALID);
    check_true("says so", strstr(stage_why(c.film), "needs the oil") != NULL);
    line_close(&c);
    static const char *const thermal[] = {"inlet", "full", "local"};
    for (int i = 0; i < 3; i++) {
        open_one_temperature(&c, i < 2 ? "ehl/finite-volume" : "ehl/film-formula", thermal[i]);
        check_true("an oil of one temperature", line_run(&c, "h_min") == FF_INVALID);
        check_true("says so", strstr(stage_why(c.film), "two temperatures or more") != NULL);
        line_close(&c);
    }
}

int main(void)
{
    test_factors();
    test_twins();
    test_order();
    test_little_heat();
    test_time();
    test_refusals();
    return check_done();
}
