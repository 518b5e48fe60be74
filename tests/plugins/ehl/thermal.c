/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `thermal: full` in complete films. */
#include "check.h"

#include "line.h"

#include <math.h>
#include <string.h>

static const double T_oil = 333.15;

/* Opens a contact with 0.09 Pa s, 2 m/s and slide-roll ratio 0.3: flash temperatures of a few
   kelvins, 15 K in the middle of the film. */
static void open_model(line *c, const char *id, double cells, double slip)
{
    line_open(c, id);
    line_grade(c, "ISO VG 320", T_oil);
    stage_set_text(c->film, "thermal", "full");
    stage_set(c->film, "cells", cells);
    stage_set(c->film, "inlet", 4);
    stage_set(c->film, "outlet", 2);
    c->u1[0] = 2 * (1 + slip / 2);
    c->u2[0] = 2 * (1 - slip / 2);
}

static void open_hot(line *c, double cells, double slip)
{
    open_model(c, "ehl/finite-volume", cells, slip);
}

static const char hot_outputs[] = "h_min h_central p_max power_loss friction_coefficient "
                                  "temperature_max flash_temperature film pressure temperature x";

/* With oil laws that do not depend on temperature, and a Newtonian oil, the film must be that of
   `thermal: none`. */
static void test_without_slope(void)
{
    double of[2][3];
    for (int hot = 0; hot < 2; hot++) {
        line c;
        open_hot(&c, 256, 0.3);
        stage_set_text(c.film, "thermal", hot ? "full" : "none");
        line_oil(&c, "viscosity/barus", c.eta0, 20e-9);
        stage_close(c.rho);
        c.rho = stage_open("density/dowson-higginson");
        stage_set(c.rho, "rho0", stage_scalar(c.liquid, "rho0"));
        stage_set(c.film, "tolerance", 1e-11);
        check_true("runs", line_run(&c, "h_min h_central p_max traction") == FF_OK);
        of[hot][0] = line_value(&c, "h_min", 0);
        of[hot][1] = line_value(&c, "h_central", 0);
        of[hot][2] = line_value(&c, "traction", 0);
        line_close(&c);
    }
    check_near("h_min of an oil that heat does not change", of[1][0], of[0][0], 1e-8);
    check_near("h_central", of[1][1], of[0][1], 1e-8);
    check_near("traction", of[1][2], of[0][2], 1e-8);
}

/* Values of one steady film. */
typedef struct values {
    double h, friction, hottest, flash, heat, flanks;
} values;

static values steady(double cells, double across, double slip, double tau0)
{
    line c;
    values v;
    open_hot(&c, cells, slip);
    if (tau0 > 0)
        line_eyring(&c, tau0);
    stage_set(c.film, "thermal_nodes", across);
    check_true("runs", line_run(&c, hot_outputs) == FF_OK);
    v.h = line_value(&c, "h_central", 0);
    v.friction = line_value(&c, "friction_coefficient", 0);
    v.hottest = line_value(&c, "temperature_max", 0) - T_oil;
    v.flash = line_value(&c, "flash_temperature", 0);
    v.heat = stage_quality(c.film, "heat_balance");
    v.flanks = stage_quality(c.film, "heat_of_flanks");
    check_below("heat balance of the equations", v.heat,
                stage_quality_limit(c.film, "heat_balance") / 10);
    line_close(&c);
    return v;
}

/* The error must decrease exponentially with the number of nodes across, and along x with the
   square of the cell size. */
static void test_orders(void)
{
    values few = steady(256, 6, 0.3, 5e6), some = steady(256, 8, 0.3, 5e6),
           many = steady(256, 12, 0.3, 5e6);
    check_near("friction with 8 nodes", some.friction, many.friction, 1e-4);
    check_near("film with 8 nodes", some.h, many.h, 1e-4);
    check_near("hottest place", some.hottest, many.hottest, 1e-2);
    check_true("two nodes more are worth a factor of two and more",
               fabs(few.friction - many.friction) > 2 * fabs(some.friction - many.friction));
    values fine = steady(512, 8, 0.3, 5e6), finest = steady(1024, 8, 0.3, 5e6);
    check_true("friction: 3 and more with twice the cells",
               fabs(some.friction - fine.friction) > 3 * fabs(fine.friction - finest.friction));
    check_true("film", fabs(some.h - fine.h) > 3 * fabs(fine.h - finest.h));
    check_true("heat by other sums falls, too", some.flanks > 2 * finest.flanks);
    check_below("heat by other sums", finest.flanks, 1e-2);
}

/* Control volumes around the nodes and between them: the films must differ by the discretisation
   error only, friction by an error of second order. */
static void test_discretisations(void)
{
    const char *id[] = {"ehl/finite-volume", "ehl/control-volume"};
    const double cells[] = {256, 512};
    double h[2][2], friction[2][2];
    for (int k = 0; k < 4; k++) {
        line c;
        open_model(&c, id[k / 2], cells[k % 2], 0.3);
        line_eyring(&c, 5e6);
        check_true("runs", line_run(&c, hot_outputs) == FF_OK);
        h[k / 2][k % 2] = line_value(&c, "h_min", 0);
        friction[k / 2][k % 2] = line_value(&c, "friction_coefficient", 0);
        check_below("heat balance of the equations", stage_quality(c.film, "heat_balance"),
                    stage_quality_limit(c.film, "heat_balance") / 10);
        line_close(&c);
    }
    check_near("h_min of both", h[1][1], h[0][1], 1e-3);
    check_near("friction of both", friction[1][1], friction[0][1], 1e-3);
    check_true("friction: 3 and more with twice the cells",
               fabs(friction[1][0] - friction[0][0]) > 3 * fabs(friction[1][1] - friction[0][1]));
}

/* Returns the friction of a steady film with a thermal conductivity of the oil; pressure: NULL, or
   a table of the conductivity over pressure. */
static double friction_of(double conductivity, const char *pressure)
{
    line c;
    open_hot(&c, 256, 0.3);
    line_eyring(&c, 5e6);
    stage_close(c.liquid);
    c.liquid = stage_open("lubricant/grade");
    stage_set_text(c.liquid, "grade", "ISO VG 320");
    stage_set(c.liquid, "temperature", T_oil);
    stage_set(c.liquid, "conductivity", conductivity);
    if (pressure)
        stage_set_text(c.liquid, "conductivity_pressure", pressure);
    stage_run(c.liquid);
    stage_link(c.oil, "oil", c.liquid);
    stage_link(c.rho, "oil", c.liquid);
    check_true("runs", line_run(&c, hot_outputs) == FF_OK);
    double friction = line_value(&c, "friction_coefficient", 0);
    line_close(&c);
    return friction;
}

/* Twice the conductivity above about 10 MPa must give the friction of twice the conductivity at any
   pressure. */
static void test_conductivity(void)
{
    double plain = friction_of(0.14, NULL), twice = friction_of(0.28, NULL);
    check_near("friction of conduction that pressure doubles",
               (friction_of(0.14, "[100 1/GPa, 100 1/GPa]") - plain) / (twice - plain), 1, 0.03);
    double paraffinic = friction_of(0.14, "[1.72 1/GPa, 0.54 1/GPa]");
    check_true("that of a paraffinic oil lies between", paraffinic > plain && paraffinic < twice);
}

/* Under constant conditions, film, heat and flank temperatures must stay steady. */
static void test_time(const char *id)
{
    line c;
    open_model(&c, id, 256, 0.3);
    stage_set(c.film, "steps", 10);
    line_last(&c, 2, 5e-4);
    check_true("runs", line_run(&c, hot_outputs) == FF_OK);
    check_near("film stays", line_value(&c, "h_central", 10), line_value(&c, "h_central", 0), 2e-4);
    check_near("friction stays", line_value(&c, "friction_coefficient", 10),
               line_value(&c, "friction_coefficient", 0), 1e-3);
    check_near("flash stays", line_value(&c, "flash_temperature", 10),
               line_value(&c, "flash_temperature", 0), 2e-3);
    line_close(&c);
}

/* Returns the film after a smooth change of load and speeds, for a number of steps. */
static values after_change(double steps)
{
    const double pi = 3.14159265358979323846;
    line c;
    values v = {0};
    open_hot(&c, 128, 0.3);
    line_eyring(&c, 5e6);
    stage_set(c.film, "steps", steps);
    stage_set(c.film, "tolerance", 1e-8);
    line_last(&c, 321, 1e-3);
    for (size_t k = 0; k < c.count; k++) {
        double rise = (1 - cos(1.25 * pi * (double)k / 320)) / 2;
        c.u1[k] *= 1 + 0.3 * rise;
        c.u2[k] *= 1 + 0.3 * rise;
        c.load[k] *= 1 + 0.5 * rise;
    }
    check_true("runs", line_run(&c, hot_outputs) == FF_OK);
    v.friction = line_value(&c, "friction_coefficient", (size_t)steps);
    v.hottest = line_value(&c, "temperature_max", (size_t)steps);
    v.flash = line_value(&c, "flash_temperature", (size_t)steps);
    line_close(&c);
    return v;
}

/* Twice as many steps must reduce the error to a third at most; second order would give a
   quarter. */
static void test_order_in_time(void)
{
    values few = after_change(40), some = after_change(80), many = after_change(160);
    check_true("friction: 3 and more with twice the steps",
               fabs(few.friction - some.friction) > 3 * fabs(some.friction - many.friction));
    check_true("hottest place",
               fabs(few.hottest - some.hottest) > 3 * fabs(some.hottest - many.hottest));
    check_true("flash", fabs(few.flash - some.flash) > 3 * fabs(some.flash - many.flash));
}

/* A thin film at 0.2 m/s under an oscillating load, with steps of several cells: all heat leaves by
   conduction, so that small errors of temperature are large errors of the heat balance. */
static void test_slow_in_time(void)
{
    const double pi = 3.14159265358979323846;
    line c;
    open_hot(&c, 256, 0.8);
    line_grade(&c, "ISO VG 100", 440);
    line_eyring(&c, 18.7e6);
    stage_set(c.film, "steps", 60);
    line_last(&c, 41, 0.03);
    for (size_t k = 0; k < c.count; k++) {
        double wave = sin(2 * pi * (double)k / 40);
        c.u1[k] *= 0.1 * (1 + 0.2 * wave);
        c.u2[k] *= 0.1 * (1 + 0.2 * wave);
        c.load[k] *= 1 + 0.4 * wave;
    }
    check_true("runs", line_run(&c, hot_outputs) == FF_OK);
    check_below("heat balance of a slow film", stage_quality(c.film, "heat_balance"), 1e-3);
    line_close(&c);
}

/* An oil with data up to 423.15 K, which enters at a kelvin less and becomes hotter than that in
   the film. */
static void test_law_range(void)
{
    line c;
    open_hot(&c, 128, 1);
    line_grade(&c, "ISO VG 320", 422.15);
    check_true("runs", line_run(&c, "h_min") == FF_OK);
    check_true("law_range", stage_quality(c.film, "law_range") > 0);
    line_close(&c);
}

/* A thin layer of the film takes all the shear: iterations with fixed mean viscosities diverge from
   this film, even with strong damping. */
static void test_localised_shear(void)
{
    line c;
    open_hot(&c, 128, 0);
    line_grade(&c, "ISO VG 100", 315);
    line_eyring(&c, 11e6);
    c.u1[0] = 10.6;
    c.u2[0] = 3.5;
    c.radius[0] = 13.5e-3;
    c.load[0] = 1.37e6; /* 1.9 GPa */
    if (check_true("runs", line_run(&c, hot_outputs) == FF_OK)) {
        check_true("hot", line_value(&c, "temperature_max", 0) > 415);
        check_below("heat balance of the equations", stage_quality(c.film, "heat_balance"),
                    stage_quality_limit(c.film, "heat_balance") / 10);
    }
    line_close(&c);
}

/* Too few cells for any film: the message must not name heat as the reason. */
static void test_too_coarse(void)
{
    line c;
    open_hot(&c, 64, 0.35);
    c.u1[0] *= 0.02;
    c.u2[0] *= 0.02;
    c.radius[0] = 44e-3;
    c.load[0] = 4.7e6; /* 2 GPa */
    check_true("no film", line_run(&c, "h_min") == FF_NOCONV);
    check_true("more cells", strstr(stage_why(c.film), "more cells") != NULL);
    line_close(&c);
}

/* The slower flank conducts less: conduction along the flank matters first in the other flank. */
static void test_flank_peclet(void)
{
    line c;
    open_hot(&c, 128, 0.3);
    stage_give_series(c.film, "gear.thermal_conductivity", 2, (double[]){50, 12});
    stage_give_series(c.film, "gear.density", 2, (double[]){7850, 7700});
    stage_give_series(c.film, "gear.specific_heat", 2, (double[]){484, 460});
    check_true("runs", line_run(&c, "h_min") == FF_OK);
    const double pi = 3.14159265358979323846;
    double a = sqrt(8 * c.load[0] * c.radius[0] / (pi * c.modulus));
    check_true("the slower flank has more", c.u2[0] * 7700 * 460 / 12 > c.u1[0] * 7850 * 484 / 50);
    check_near("flank_peclet, of the faster flank", stage_quality(c.film, "flank_peclet"),
               c.u1[0] * a * 7850 * 484 / 50, 1e-9);
    line_close(&c);
}

static void test_refusals(void)
{
    line c;
    line_open(&c, "ehl/finite-volume");
    stage_set_text(c.film, "thermal", "full");
    check_true("no oil", line_run(&c, "h_min") == FF_INVALID);
    check_true("says so", strstr(stage_why(c.film), "needs the oil") != NULL);
    line_close(&c);
    open_hot(&c, 128, 0.3);
    stage_set_text(c.film, "thermal", "none");
    check_true("no temperature without", line_run(&c, "temperature_max") == FF_UNSUPPORTED);
    line_close(&c);
    open_hot(&c, 128, 2);
    check_true("a flank at rest in a steady film", line_run(&c, "h_min") == FF_UNSUPPORTED);
    check_true("says so", strstr(stage_why(c.film), "no steady temperature") != NULL);
    line_close(&c);
    open_hot(&c, 128, 2);
    stage_set(c.film, "steps", 4);
    line_last(&c, 2, 1e-4);
    check_true("in time it has one", line_run(&c, "h_min") == FF_OK);
    line_close(&c);
    open_hot(&c, 128, 2.5);
    check_true("flanks against each other", line_run(&c, "h_min") == FF_UNSUPPORTED);
    check_true("says that, too", strstr(stage_why(c.film), "opposite directions") != NULL);
    line_close(&c);
}

int main(void)
{
    test_without_slope();
    test_orders();
    test_conductivity();
    test_time("ehl/finite-volume");
    test_time("ehl/control-volume");
    test_discretisations();
    test_order_in_time();
    test_slow_in_time();
    test_law_range();
    test_localised_shear();
    test_too_coarse();
    test_flank_peclet();
    test_refusals();
    return check_done();
}
