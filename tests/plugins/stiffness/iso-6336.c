/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ISO 6336-1 against figures worked by hand for the 50/50 pair. */
#include "chain.h"
#include "check.h"

#include <math.h>
#include <string.h>

static const char model[] = "stiffness/iso-6336";
/* q' = 0.0554984 mm um/N; c' = 0.8/q' = 14.4148 N/(mm um) with C_B = 1; 20 mm wide */
static const double single = 14.4148e9 * 0.02, ratio = 1.75467;

/* With a dedendum of 1.2 module C_B is 1. */
static chain open_pair(const char *torque)
{
    chain c = chain_open(model, torque);
    stage_set_text(c.gear, "root_diameter", "142.8 mm");
    return c;
}

static void test_worked_figures(void)
{
    chain c = open_pair("250 N m");
    check_near("c_gamma b", chain_mean(&c), 22.574e9 * 0.02, 2e-5);
    size_t n;
    const double *k = stage_get(c.mesh, "stiffness", &n);
    check_near("two pairs", k[0], 1.75 * single, 1e-5);
    check_near("one pair", k[n - 1], single, 1e-5);
    check_near("equal parts", stage_get(c.mesh, "load_share", NULL)[0], 0.5, 1e-12);
    double step = 0.75 * single, amplitude = 2 / M_PI * step * fabs(sin(M_PI * (ratio - 1)));
    check_near("harmonic of a rectangle", stage_get(c.mesh, "stiffness_harmonics", NULL)[0],
               amplitude, 1e-4);
    check_true("trusted", stage_verdict(c.mesh) == FF_GOOD);
    chain_close(&c);
}

static void test_trapezoid(void)
{
    chain c = open_pair("250 N m");
    stage_set_text(c.mesh, "shape", "trapezoidal");
    check_near("the same mean", chain_mean(&c), 22.574e9 * 0.02, 2e-5);
    size_t n;
    const double *share = stage_get(c.mesh, "load_share", &n);
    double worst = 0;
    for (size_t i = 1; i < n; i++)
        worst = fmax(worst, fabs(share[i] - share[i - 1]));
    check_below("no jump", worst, 0.06);
    check_near("a third at SAP", share[0], 1.0 / 3, 1e-9);
    check_below("equilibrium", stage_quality(c.mesh, "equilibrium"), 1e-12);
    check_near("ramps lengthen the contact", stage_scalar(c.mesh, "loaded_contact_ratio"),
               ratio + 0.2, 1e-4);
    chain_close(&c);
}

/* Pairs that come over a ramp touch before SAP with the gap of SAP: the relief unloads them there
   as much as behind it. */
static void test_relief_before_sap(void)
{
    chain c = open_pair("250 N m");
    stage_set_text(c.mesh, "shape", "trapezoidal");
    stage_set_text(c.gear, "tip_relief", "5 um");
    stage_set_text(c.gear, "stations", "2000");
    chain_run(&c);
    size_t n, i = 0;
    const double *roll = stage_get(c.mesh, "engagement_roll", &n);
    const double *force = stage_get(c.mesh, "engagement_force", NULL);
    double sap = stage_scalar(c.gear, "roll_sap"), step = 2 * M_PI / 50 * 0.1 / 40;
    while (i < n && roll[i] < sap)
        i++;
    check_near("the points before SAP reach it", roll[i - 1], sap - step, 1e-9);
    /* the ramp's own rise is F/2 in 40 such steps, more where the other pair leaves it the load */
    check_below("no jump at SAP", fabs(force[i] - force[i - 1]), 0.05 * force[i]);
    check_true("loaded", force[i] > 0);
    chain_close(&c);
}

static void test_dedendum(void)
{
    chain c = chain_open(model, "250 N m");
    check_near("C_B of 1.25 module", chain_mean(&c), 0.975 * 22.574e9 * 0.02, 2e-5);
    chain_close(&c);
}

/* Below F_t/b = 100 N/mm the stiffness is in proportion to the load. */
static void test_light_load(void)
{
    chain a = open_pair("300 N m"), b = open_pair("150 N m"), d = open_pair("75 N m");
    double full = chain_mean(&a), limit = chain_mean(&b), half = chain_mean(&d);
    check_near("100 N/mm", limit, full, 1e-12);
    check_near("50 N/mm", half, full / 2, 1e-9);
    chain_close(&a);
    chain_close(&b);
    chain_close(&d);
}

static void test_relief_unloads_a_pair(void)
{
    chain c = open_pair("250 N m");
    stage_set_text(c.gear, "tip_relief", "20 um");
    chain_run(&c);
    size_t n;
    const double *k = stage_get(c.mesh, "stiffness", &n);
    check_true("nothing at SAP", !(stage_get(c.mesh, "load_share", NULL)[0] > 0));
    check_near("one pair has c'", k[0], single, 1e-4);
    chain_close(&c);
}

static void test_refusals(void)
{
    chain c = open_pair("250 N m");
    stage_give_scalar(c.mesh, "operating.line_force", 0);
    check_true("no load",
               stage_run(c.mesh) < 0 && !strcmp(stage_why_item(c.mesh), "operating.line_force"));
    chain_close(&c);
}

int main(void)
{
    test_worked_figures();
    test_trapezoid();
    test_relief_before_sap();
    test_dedendum();
    test_light_load();
    test_relief_unloads_a_pair();
    test_refusals();
    return check_done();
}
