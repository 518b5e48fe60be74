/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws with an oil: the values that they get from it, over temperature. */
#include "check.h"
#include "stage.h"

#include "../../../plugins/numerics/isothermal.h"

#include <flankfilm/laws.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { POINTS = 600 };

static const struct {
    const char *id, *set[4][2];
} laws[] = {
    {"viscosity/isoviscous", {{NULL, NULL}}},
    {"viscosity/barus", {{NULL, NULL}}},
    {"viscosity/roelands", {{NULL, NULL}}},
    {"viscosity/roelands", {{"z", "0.58"}}},
    {"viscosity/barus", {{"alpha", "17 1/GPa"}}},
    {"viscosity/roelands", {{"alpha", "17 1/GPa"}}},
    {"viscosity/two-slope",
     {{"alpha_1", "12 1/GPa"}, {"alpha_2", "7 1/GPa"}, {"p_transition", "0.17 GPa"}}},
    {"viscosity/doolittle-tait",
     {{"B", "3.73"}, {"V_occ", "0.6132"}, {"K0", "1.05 GPa"}, {"K0_prime", "10.076"}}},
};
enum { LAWS = sizeof laws / sizeof *laws };

static stage *open_oil(void)
{
    stage *oil = stage_open("lubricant/grade");
    stage_set_text(oil, "grade", "ISO VG 220");
    stage_set_text(oil, "base", "PAO");
    return oil;
}

static double property(stage *oil, int32_t what, double T)
{
    const ff_liquid *l = stage_service(oil, FF_LIQUID_ID);
    double value;
    l->eval(l->self, what, 1, &T, &value, NULL);
    return value;
}

static stage *open_law(size_t k)
{
    stage *law = stage_open(laws[k].id);
    for (size_t i = 0; i < 4 && laws[k].set[i][0]; i++)
        stage_set_text(law, laws[k].set[i][0], laws[k].set[i][1]);
    return law;
}

/* Opens law k without an oil, with the oil's viscosity and pressure coefficient at T. */
static stage *open_law_at(size_t k, stage *oil, double T)
{
    stage *law = open_law(k);
    stage_set(law, "eta0", exp(property(oil, FF_LIQUID_LN_ETA0, T)));
    if (k == 1 || k == 2)
        stage_set(law, "alpha", property(oil, FF_LIQUID_PRESSURE_COEFFICIENT, T));
    return law;
}

/* Sets pressures from negative ones to beyond the cap, and temperatures that are equal or in
   pairs. */
static void fill(double *p, double *T, double first, double step)
{
    for (int i = 0; i < POINTS; i++) {
        p[i] = -1e7 + 3e6 * i;
        T[i] = first + step * (i / 7);
    }
}

static void is_the_law_of_its_oil(size_t k)
{
    static double p[POINTS], T[POINTS], ln_eta[POINTS], dp[POINTS], expected[POINTS], slope[POINTS];
    stage *oil = open_oil(), *law = open_law(k), *same = open_law_at(k, oil, 353.15);
    stage_link(law, "oil", oil);
    const ff_viscosity *v = stage_service(law, FF_VISCOSITY_ID);
    const ff_viscosity *w = stage_service(same, FF_VISCOSITY_ID);
    double worst = 0;
    fill(p, T, 353.15, 0);
    check_true(laws[k].id, v->eval(v->self, POINTS, p, T, ln_eta, dp, NULL) == FF_OK);
    w->eval(w->self, POINTS, p, NULL, expected, slope, NULL);
    for (int i = 0; i < POINTS; i++)
        worst = fmax(worst, fmax(fabs(ln_eta[i] - expected[i]) / 10, fabs(dp[i] / slope[i] - 1)));
    if (k == 0) /* no slope */
        worst = fabs(ln_eta[9] - expected[9]);
    check_below("as with eta0 and alpha given", worst, 1e-12);
    stage_close(same);
    stage_close(law);
    stage_close(oil);
}

static void slopes_agree(size_t k)
{
    static double p[POINTS], T[POINTS], ln_eta[POINTS], dp[POINTS], dT[POINTS], above[POINTS],
        below[POINTS];
    stage *oil = open_oil(), *law = open_law(k);
    stage_link(law, "oil", oil);
    const ff_viscosity *v = stage_service(law, FF_VISCOSITY_ID);
    double worst = 0, h = 1e-3;
    fill(p, T, 300, 1);
    v->eval(v->self, POINTS, p, T, ln_eta, dp, dT);
    for (int i = 0; i < POINTS; i++)
        T[i] += h;
    v->eval(v->self, POINTS, p, T, above, NULL, NULL);
    for (int i = 0; i < POINTS; i++)
        T[i] -= 2 * h;
    v->eval(v->self, POINTS, p, T, below, NULL, NULL);
    for (int i = 0; i < POINTS; i++)
        worst = fmax(worst, fabs((above[i] - below[i]) / (2 * h) - dT[i]) / fabs(dT[i]));
    check_below("dln_dT against differences", worst, 1e-6);
    stage_close(law);
    stage_close(oil);
}

/* Without a temperature, the law must use an assumed one and report it. It must be finite at any
   temperature. */
static void answers_without_and_at_any_temperature(size_t k)
{
    static const double T[] = {-DBL_MAX, 0, 1, 1e4, DBL_MAX}, p[] = {1e9, -1e30, 1e30, 1e12, 0};
    stage *oil = open_oil(), *law = open_law(k);
    stage_link(law, "oil", oil);
    const ff_viscosity *v = stage_service(law, FF_VISCOSITY_ID);
    double ln_eta[5], dp[5], dT[5], none;
    check_true("no temperature",
               v->eval(v->self, 1, p, NULL, &none, NULL, NULL) == FF_DOMAIN && isfinite(none));
    check_true("any temperature", v->eval(v->self, 5, p, T, ln_eta, dp, dT) == FF_DOMAIN);
    for (int i = 0; i < 5; i++)
        check_true("finite", isfinite(ln_eta[i]) && isfinite(dp[i]) && isfinite(dT[i]));
    stage_close(law);
    stage_close(oil);
}

/* A law that needs the pressure coefficient, with an oil that does not have it. */
static void needs_the_coefficient_of_the_oil(void)
{
    static const char *const ids[] = {"viscosity/barus", "viscosity/roelands"};
    for (int i = 0; i < 2; i++) {
        stage *oil = stage_open("lubricant/measured"), *law = stage_open(ids[i]);
        stage_set_text(oil, "eta0", "5 mPa s");
        stage_set_text(oil, "at", "100 degC");
        stage_set_text(oil, "density", "918 kg/m3");
        stage_link(law, "oil", oil);
        check_true(ids[i], stage_ready(law) == FF_INVALID);
        printf("%s\n", stage_why(law));
        stage_close(law);
        stage_close(oil);
    }
}

static void densities_take_the_oil(void)
{
    stage *oil = open_oil(), *law = stage_open("density/dowson-higginson");
    stage_link(law, "oil", oil);
    const ff_density *d = stage_service(law, FF_DENSITY_ID);
    double p[2] = {0, 1e9}, T[2] = {353.15, 353.15}, rho[2], dp[2], dT[2], above[2];
    check_true("evaluates", d->eval(d->self, 2, p, T, rho, dp, dT) == FF_OK);
    check_near("rho0", rho[0], property(oil, FF_LIQUID_RHO0, 353.15), 1e-14);
    check_near("at 1 GPa", rho[1] / rho[0], 1 + 0.6 / 2.7, 1e-14);
    check_near("drho_dp", dp[0], 0.6e-9 * rho[0], 1e-14);
    T[1] += 1e-3;
    d->eval(d->self, 2, p, T, above, NULL, NULL);
    check_near("drho_dT", dT[1], (above[1] - rho[1]) / 1e-3, 1e-5);
    stage_close(law);
    stage_close(oil);
}

/* A wrong lubricant: it fails below 300 K, and has an infinite slope above 400 K. */
static ff_status answer_badly(const void *self, int32_t what, size_t n, const double *T,
                              double *value, double *slope)
{
    (void)self;
    (void)what;
    for (size_t i = 0; i < n; i++) {
        value[i] = log(0.01);
        if (slope)
            slope[i] = T[i] > 400 ? HUGE_VAL : -0.04;
        if (T[i] < 300)
            return FF_NOMEM;
    }
    return FF_OK;
}

static void tells_of_an_oil_that_fails(void)
{
    const ff_liquid bad = {sizeof bad, NULL, answer_badly};
    double T[] = {290, 350, 410}, value, slope;
    check_true("an oil without memory", numerics_liquid_values(&bad, FF_LIQUID_LN_ETA0, 1, &T[0],
                                                               &value, &slope) == FF_NOMEM);
    check_true("an oil",
               numerics_liquid_values(&bad, FF_LIQUID_LN_ETA0, 1, &T[1], &value, &slope) == FF_OK);
    check_true("a slope of an oil",
               numerics_liquid_values(&bad, FF_LIQUID_LN_ETA0, 1, &T[2], &value, &slope) == FF_BUG);
}

/* A wrong density law, with a slope of NaN. */
static ff_status steepen(const void *self, size_t n, const double *p, const double *T, double *rho,
                         double *drho_dp, double *drho_dT)
{
    (void)self, (void)p, (void)T, (void)drho_dT;
    for (size_t i = 0; i < n; i++) {
        rho[i] = 850;
        if (drho_dp)
            drho_dp[i] = NAN;
    }
    return FF_OK;
}

static void slopes_of_a_density_are_held(void)
{
    static numerics_density_at at;
    const ff_density law = {sizeof law, NULL, steepen};
    numerics_answers answers = {.status = FF_OK};
    const ff_density *held = numerics_density_make(&at, &law, 350, &answers);
    double p = 1e9, rho, slope;
    held->eval(held->self, 1, &p, NULL, &rho, NULL, NULL);
    check_true("a value alone", answers.status == FF_OK);
    held->eval(held->self, 1, &p, NULL, &rho, &slope, NULL);
    check_true("a slope", answers.status == FF_BUG && strstr(answers.text, "the slope of rho nan"));
}

int main(void)
{
    tells_of_an_oil_that_fails();
    slopes_of_a_density_are_held();
    for (size_t k = 0; k < LAWS; k++) {
        is_the_law_of_its_oil(k);
        slopes_agree(k);
        answers_without_and_at_any_temperature(k);
    }
    needs_the_coefficient_of_the_oil();
    densities_take_the_oil();
    return check_done();
}
