/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares ISO 6336-1 with values worked out by hand for the 50/50 pair, with two published
   reports, and with its series, programmed again here, for unequal pairs in either order. */
#include "chain.h"
#include "check.h"

#include <math.h>
#include <string.h>

static const char model[] = "stiffness/iso-6336";
/* q' = 0.0554984 mm um/N; c' = 0.8/q' = 14.4148 N/(mm um) with C_B = 1; 20 mm wide */
static const double single = 14.4148e9 * 0.02, ratio = 1.75467;

/* Opens the pair with a dedendum of 1.2 modules, so that C_B is 1. */
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
    check_near("F over one pair less F over two, peak to peak",
               stage_scalar(c.mesh, "transmission_error_peak_to_peak"),
               3547.26 / single * (1 - 1 / 1.75), 2e-5);
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

/* A pair whose load begins with a ramp touches before SAP, with the gap of SAP: the relief must
   reduce its load before SAP as after it. */
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
    /* the ramp increases by F/2 in 40 such steps, or faster if the other pair's load decreases */
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

/* C_B must be 1 - 0.02 (20 - alpha), alpha in degrees, for a rack with a dedendum of 1.2
   modules. */
static void test_pressure_angle(void)
{
    chain c = open_pair("250 N m");
    stage_set_text(c.gear, "pressure_angle", "25 deg");
    chain_run(&c);
    size_t n;
    const double *k = stage_get(c.mesh, "stiffness", &n);
    check_near("one pair of 25 degrees", k[n - 1], 1.1 * single, 1e-5);
    chain_close(&c);
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

/* An unequal pair, entered in either order: gear 2 second or first. */
typedef struct unequal {
    double teeth[2], shift[2], modulus[2], dedendum[2]; /* GPa */
    double module, width, centre, blank;                /* mm; centre 0: from the shifts */
} unequal;

static chain open_unequal(const unequal *u, int first)
{
    chain c = {stage_open("gear/involute-spur"), stage_open("operating/steady"), stage_open(model)};
    const struct {
        const char *name;
        const double *of;
        double unit;
    } pairs[] = {{"teeth", u->teeth, 1},
                 {"profile_shift", u->shift, 1},
                 {"elastic_modulus", u->modulus, 1e9},
                 {"dedendum", u->dedendum, 1}};
    for (size_t k = 0; k < sizeof pairs / sizeof pairs[0]; k++) {
        const double both[2] = {pairs[k].of[first] * pairs[k].unit,
                                pairs[k].of[1 - first] * pairs[k].unit};
        stage_set_reals(c.gear, pairs[k].name, 2, both);
    }
    stage_set(c.gear, "module", 1e-3 * u->module);
    stage_set(c.gear, "face_width", 1e-3 * u->width);
    if (u->centre > 0)
        stage_set(c.gear, "centre_distance", 1e-3 * u->centre);
    stage_set(c.mesh, "blank_factor", u->blank);
    /* 600 N/mm at the reference circle of gear 1 */
    stage_set(c.duty, "torque", 600 * u->width * 1e-3 * u->module * u->teeth[first] / 2);
    stage_set_text(c.duty, "speed", "100 rpm");
    stage_link(c.duty, "gear", c.gear);
    stage_link(c.mesh, "gear", c.gear);
    stage_link(c.mesh, "operating", c.duty);
    return c;
}

/* KISSsoft 03/2017, ISO 6336:2006 method B, in the repository gfsReboucas/Drivetrain, files
   @NREL_5MW/stage_01.rtf and stage_02.rtf: [cgalf] in N/(mm um) of sun and planet, with [CR] 0.862.
   The pinion of the first is the planet. */
static void test_printed_reports(void)
{
    static const struct {
        const char *what;
        unequal pair;
        double printed;
        int pinion;
    } reports[] = {
        {"19/17, c_gamma 13.426",
         {{19, 17}, {0.617, 0.8021}, {206, 206}, {1.25, 1.25}, 45, 491, 863, 0.862},
         13.426,
         1},
        {"18/36, c_gamma 15.640",
         {{18, 36}, {0.389, 0.5039}, {206, 206}, {1.25, 1.25}, 21, 550, 0, 0.862},
         15.640,
         0},
    };
    for (size_t k = 0; k < sizeof reports / sizeof reports[0]; k++)
        for (int first = 0; first < 2; first++) {
            chain c = open_unequal(&reports[k].pair, first);
            double mean = chain_mean(&c) / (1e-3 * reports[k].pair.width) / 1e9;
            check_near(reports[k].what, mean, reports[k].printed, 3e-3);
            check_near("the pinion", stage_scalar(c.gear, "pinion"),
                       reports[k].pinion == first ? 1 : 2, 0);
            chain_close(&c);
        }
}

/* The series and factors of ISO 6336-1, clause 9, programmed again, for a steel pinion with a wheel
   of cast iron. */
static void test_series(void)
{
    static const unequal pairs[] = {
        {{17, 43}, {0.35, -0.1}, {206, 118}, {1.25, 1.1}, 3, 22, 0, 1},
        {{60, 21}, {-0.2, 0.2}, {170, 206}, {1.2, 1.4}, 4, 30, 0, 0.9},
    };
    for (size_t k = 0; k < 2; k++)
        for (int first = 0; first < 2; first++) {
            const unequal *u = &pairs[k];
            const int one = u->teeth[1] < u->teeth[0];
            const double z1 = u->teeth[one], z2 = u->teeth[1 - one], x1 = u->shift[one],
                         x2 = u->shift[1 - one];
            const double q = 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x1 -
                             0.11654 * x1 / z1 - 0.00193 * x2 - 0.24188 * x2 / z2 +
                             0.00529 * x1 * x1 + 0.00182 * x2 * x2;
            const double rack = 1 + 0.5 * (1.2 - (u->dedendum[0] + u->dedendum[1]) / 2);
            const double modulus =
                2 * u->modulus[0] * u->modulus[1] / (u->modulus[0] + u->modulus[1]) / 206;
            chain c = open_unequal(u, first);
            double mean = chain_mean(&c) / (1e-3 * u->width) / 1e9;
            double ratio_of = stage_scalar(c.gear, "contact_ratio");
            check_near("c_gamma of an unequal pair", mean,
                       0.8 * u->blank * rack * modulus / q * (0.75 * ratio_of + 0.25), 1e-10);
            chain_close(&c);
        }
}

/* A plugin may give the number of the pinion, which must be 1 or 2. */
static void test_pinion_told(void)
{
    chain c = open_pair("250 N m");
    chain_run(&c);
    stage_give_scalar(c.mesh, "gear.pinion", 1.5);
    check_true("no such pinion",
               stage_run(c.mesh) < 0 && !strcmp(stage_why_item(c.mesh), "gear.pinion"));
    stage_give_scalar(c.mesh, "gear.pinion", 2);
    check_true("gear 2 of equal ones", stage_run(c.mesh) == FF_OK);
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
    test_pressure_angle();
    test_light_load();
    test_relief_unloads_a_pair();
    test_printed_reports();
    test_series();
    test_pinion_told();
    test_refusals();
    return check_done();
}
