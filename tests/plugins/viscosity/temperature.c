/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws over temperature: at ambient pressure, they must have the oil's viscosity; their slopes must
   agree with central differences, to second order; and at one temperature, they must be the
   isothermal law. */
#include "check.h"
#include "stage.h"

#include <difference.h>

#include <flankfilm/laws.h>

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

typedef struct setting {
    const char *name, *text;
} setting;

typedef struct law {
    const char *id;
    bool bare; /* without an oil */
    setting set[10];
} law;

#define FREE_VOLUME                                                                                \
    {"B", "3.73"}, {"V_occ", "0.6132"}, {"K0", "1.05 GPa"}, {"K0_prime", "10.076"},                \
        {"K0_decay", "0.0063 1/K"}, {"V_occ_slope", "-0.0025 1/K"},                                \
    {                                                                                              \
        "at", "100 degC"                                                                           \
    }
#define TWO_SLOPES                                                                                 \
    {"alpha_1", "15 1/GPa"}, {"alpha_2", "7 1/GPa"}, {"p_transition", "0.4 GPa"},                  \
    {                                                                                              \
        "transition_width", "0.3 GPa"                                                              \
    }
#define COEFFICIENT                                                                                \
    {"alpha", "18 1/GPa"}, {"alpha_slope", "-0.006 1/K"},                                          \
    {                                                                                              \
        "at", "80 degC"                                                                            \
    }
#define GLASS                                                                                      \
    {"Tg0", "-28.2 degC"}, {"A1", "134.2 K"}, {"A2", "1.929 1/GPa"}, {"B1", "4.815"},              \
        {"B2", "0.160 1/GPa"}, {"C1", "16.01"},                                                    \
    {                                                                                              \
        "C2", "20.69 K"                                                                            \
    }

static const law laws[] = {
    {"viscosity/isoviscous", false, {{NULL, NULL}}},
    {"viscosity/barus", false, {{NULL, NULL}}},
    {"viscosity/barus", false, {COEFFICIENT}},
    {"viscosity/barus", true, {COEFFICIENT}},
    {"viscosity/roelands", false, {{NULL, NULL}}},
    {"viscosity/roelands", false, {{"z", "0.58"}}},
    {"viscosity/roelands", false, {COEFFICIENT}},
    {"viscosity/roelands", true, {COEFFICIENT}},
    {"viscosity/roelands", true, {{"z", "0.58"}, {"s0", "1.1"}, {"at", "80 degC"}}},
    {"viscosity/two-slope", false, {TWO_SLOPES, {"alpha_slope", "-0.006 1/K"}, {"at", "80 degC"}}},
    {"viscosity/two-slope", true, {TWO_SLOPES, {"alpha_slope", "-0.006 1/K"}, {"at", "80 degC"}}},
    {"viscosity/doolittle-tait", false, {FREE_VOLUME}},
    {"viscosity/doolittle-tait", true, {FREE_VOLUME}},
    {"viscosity/doolittle-tait", false, {FREE_VOLUME, {"pressure_cap", "2 GPa"}}},
    {"viscosity/doolittle-tait", true, {FREE_VOLUME, {"pressure_cap", "5 GPa"}}},
    {"viscosity/yasutomi", false, {GLASS}},
    {"viscosity/yasutomi", true, {GLASS}},
    {"viscosity/yasutomi", true, {GLASS, {"pressure_cap", "0.3 GPa"}}},
    {"viscosity/modulus", false, {{NULL, NULL}}},
    {"viscosity/modulus", true, {{"base", "PAO"}}},
    {"viscosity/modulus",
     false,
     {{"a1", "-20 MPa"}, {"a2", "220 kPa/K"}, {"pressure_cap", "1 GPa"}}},
};
enum { LAWS = sizeof laws / sizeof *laws };

static stage *open_oil(void)
{
    stage *oil = stage_open("lubricant/grade");
    stage_set_text(oil, "grade", "ISO VG 220");
    return oil;
}

static stage *open_law(const law *l, stage *oil)
{
    stage *s = stage_open(l->id);
    for (size_t i = 0; i < 10 && l->set[i].name; i++)
        stage_set_text(s, l->set[i].name, l->set[i].text);
    if (l->bare)
        stage_set_text(s, "eta0", "30 mPa s");
    else
        stage_link(s, "oil", oil);
    return s;
}

typedef struct answer {
    double ln_eta, by_p, by_T;
    ff_status status;
} answer;

static answer at(const ff_viscosity *v, double p, double T)
{
    answer a;
    a.status = v->eval(v->self, 1, &p, &T, &a.ln_eta, &a.by_p, &a.by_T);
    return a;
}

/* From negative pressures to 6 GPa, and -3 to 147 degC. */
enum { PRESSURES = 14, TEMPERATURES = 11, POINTS = PRESSURES * TEMPERATURES };

static void fill(double p[POINTS], double T[POINTS])
{
    static const double pressures[PRESSURES] = {-5e7,  0,     1e7,   1e8,   2e8, 3.1e8, 5e8,
                                                7.3e8, 1.1e9, 1.7e9, 2.3e9, 3e9, 4.1e9, 6e9};
    for (int i = 0; i < POINTS; i++) {
        p[i] = pressures[i % PRESSURES];
        T[i] = 270 + 15.0 * (i / PRESSURES);
    }
}

static void passes_through_the_oil(const ff_viscosity *v, const ff_liquid *oil)
{
    bool same = true;
    for (double T = 265; T < 430; T += 7) {
        double ln_eta0, slope;
        oil->eval(oil->self, FF_LIQUID_LN_ETA0, 1, &T, &ln_eta0, &slope);
        same = same && fabs(at(v, 0, T).ln_eta - ln_eta0) <= 8 * DBL_EPSILON;
        same = same && fabs(at(v, 0, T).by_T - slope) < 1e-13;
    }
    check_true("  passes through the oil at ambient pressure", same);
}

/* Whether the law has no kink within 2 K; beyond its range, it has some. */
static bool is_smooth(const ff_viscosity *v, double p, double T)
{
    return at(v, p, T + 2).status == FF_OK && at(v, p, T - 2).status == FF_OK;
}

/* Returns the sum of squares of the errors of differences over 2 h. */
static double missed(const ff_viscosity *v, const double *p, const double *T, double h)
{
    double sum = 0;
    for (int i = 0; i < POINTS; i++) {
        double above = at(v, p[i], T[i] + h).ln_eta, below = at(v, p[i], T[i] - h).ln_eta;
        double d = (above - below) / (2 * h) - at(v, p[i], T[i]).by_T;
        if (is_smooth(v, p[i], T[i]))
            sum += d * d;
    }
    return sum;
}

typedef struct line {
    const ff_viscosity *v;
    double p, T;
} line;

static double of_T(const void *ctx, double T)
{
    const line *l = ctx;
    return at(l->v, l->p, T).ln_eta;
}

static double of_p(const void *ctx, double p)
{
    const line *l = ctx;
    return at(l->v, p, l->T).ln_eta;
}

static void has_its_slopes(const ff_viscosity *v, const double *p, const double *T)
{
    double coarse = missed(v, p, T, 2), fine = missed(v, p, T, 1), worst = 0, worst_p = 0;
    for (int i = 0; i < POINTS; i++) {
        line l = {v, p[i], T[i]};
        answer a = at(v, p[i], T[i]);
        double step = 1e6;
        if (a.by_T != 0 && at(v, p[i], T[i] + 0.1).status == at(v, p[i], T[i] - 0.1).status)
            worst = fmax(worst, fabs(difference(of_T, &l, T[i], 0.1) / a.by_T - 1));
        if (p[i] != 0 && a.by_p > 0 &&
            at(v, p[i] + step, T[i]).status == at(v, p[i] - step, T[i]).status)
            worst_p = fmax(worst_p, fabs(difference(of_p, &l, p[i], step) / a.by_p - 1));
    }
    if (coarse > 1e-20)
        check_near("  the error of differences over T falls at order 2", sqrt(coarse / fine), 4,
                   0.02);
    check_below("  dln_dT against differences", worst, 1e-7);
    check_below("  dln_dp against differences", worst_p, 1e-7);
}

/* Points at one temperature, for which laws use other loops, and calls without slopes. */
static void one_temperature_is_no_other_law(const ff_viscosity *v, const double *p)
{
    double T[PRESSURES], ln_eta[PRESSURES], by_p[PRESSURES], worst = 0;
    for (double t = 275; t < 430; t += 20) {
        for (int i = 0; i < PRESSURES; i++)
            T[i] = t;
        v->eval(v->self, PRESSURES, p, T, ln_eta, by_p, NULL);
        for (int i = 0; i < PRESSURES; i++) {
            answer a = at(v, p[i], t);
            worst = fmax(worst, fabs(ln_eta[i] - a.ln_eta) / fmax(1, fabs(a.ln_eta)));
            worst = fmax(worst, fabs(by_p[i] - a.by_p) * 1e8);
        }
    }
    check_below("  the same in a batch of one temperature", worst, 1e-12);
}

static void stays_finite(const ff_viscosity *v)
{
    static const double T[] = {-DBL_MAX, 0, 1, 140, 244, 1e4, DBL_MAX};
    static const double p[] = {-1e30, -1e9, 0, 1e9, 1e12, 1e30};
    bool finite = true;
    for (int i = 0; i < 7; i++)
        for (int k = 0; k < 6; k++) {
            answer a = at(v, p[k], T[i]);
            finite = finite && isfinite(a.ln_eta) && isfinite(a.by_p) && isfinite(a.by_T);
            finite = finite && a.by_p >= 0;
        }
    check_true("  finite at any temperature, never falling with pressure", finite);
}

static double rise(stage *s, double p, double T)
{
    const ff_viscosity *v = stage_service(s, FF_VISCOSITY_ID);
    return at(v, p, T).ln_eta - at(v, 0, T).ln_eta;
}

/* Doolittle-Tait at another temperature must be the isothermal law with the constants there; the
   cap, 2 GPa at the temperature `at`, is proportional to K0. */
static void free_volume_is_that_of_its_temperature(void)
{
    for (double T = 293.15; T < 430; T += 25) {
        stage *hot = open_law(&laws[14], NULL), *same = stage_open("viscosity/doolittle-tait");
        double soft = exp(-0.0063 * (T - 373.15));
        stage_set_text(same, "eta0", "30 mPa s");
        stage_set_text(same, "B", "3.73");
        stage_set_text(same, "K0_prime", "10.076");
        stage_set(same, "K0", 1.05e9 * soft);
        stage_set(same, "V_occ", 0.6132 * exp(-0.0025 * (T - 373.15)));
        for (double p = 2e8; p < 1.2e9; p += 2e8)
            check_near("rise", rise(hot, p, T), rise(same, p, T), 1e-12);
        stage_close(hot);
        stage_close(same);
    }
}

/* Roelands' law must be Houpert's (1985): eta0 exp{(ln eta0 + 9.67) [(1 + p/p0)^z [(T - 138)/(T0 -
   138)]^-S0 - 1]}. */
static void roelands_is_houperts(void)
{
    stage *s = open_law(&laws[8], NULL);
    const ff_viscosity *v = stage_service(s, FF_VISCOSITY_ID);
    for (double T = 293.15; T < 430; T += 25)
        for (double p = 0; p < 2e9; p += 4e8) {
            double L = log(0.03) + 9.67, fall = pow((T - 138) / (353.15 - 138), -1.1);
            check_near("Houpert", at(v, p, T).ln_eta,
                       log(0.03) + L * (pow(1 + p / 196e6, 0.58) * fall - 1), 1e-12);
        }
    stage_close(s);
}

/* 5P4E by Ehret, Dowson & Taylor, lg eta = 12 - 16.01 X/(20.69 + X), compared with values of four
   digits computed from it elsewhere. */
static void glass_of_5p4e(void)
{
    stage *s = open_law(&laws[16], NULL);
    check_near("40 degC, 0.1 GPa", exp(rise(s, 1e8, 313.15)), 22.3 / 0.5206, 2e-3);
    check_near("100 degC, 0.1 GPa", exp(rise(s, 1e8, 373.15)), 0.0654 / 0.0164, 3e-3);
    check_near("100 degC, 0.2 GPa", exp(rise(s, 2e8, 373.15)), 0.379 / 0.0164, 3e-3);
    check_near("100 degC, 0.4 GPa", exp(rise(s, 4e8, 373.15)), 66.8 / 0.0164, 3e-3);
    stage_close(s);
}

/* A slope over temperature needs the temperature at which the constants are given. */
static void needs_where_constants_hold(void)
{
    static const law bad[] = {
        {"viscosity/barus", true, {{"alpha", "18 1/GPa"}, {"alpha_slope", "-0.006 1/K"}}},
        {"viscosity/roelands", true, {{"z", "0.58"}, {"s0", "1.1"}}},
        {"viscosity/two-slope", true, {TWO_SLOPES, {"alpha_slope", "-0.006 1/K"}}},
        {"viscosity/doolittle-tait",
         true,
         {{"B", "3.73"},
          {"V_occ", "0.6132"},
          {"K0", "1.05 GPa"},
          {"K0_prime", "10.076"},
          {"V_occ_slope", "-0.001 1/K"}}},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        stage *s = open_law(&bad[i], NULL);
        check_true(bad[i].id, stage_ready(s) == FF_INVALID && !strcmp(stage_why_item(s), "at"));
        printf("%s\n", stage_why(s));
        stage_close(s);
    }
}

int main(void)
{
    double p[POINTS], T[POINTS];
    fill(p, T);
    stage *oil = open_oil();
    for (size_t k = 0; k < LAWS; k++) {
        stage *s = open_law(&laws[k], oil);
        const ff_viscosity *v = stage_service(s, FF_VISCOSITY_ID);
        printf("%s%s\n", laws[k].id, laws[k].bare ? ", bare" : "");
        if (!laws[k].bare)
            passes_through_the_oil(v, stage_service(oil, FF_LIQUID_ID));
        has_its_slopes(v, p, T);
        one_temperature_is_no_other_law(v, p);
        stays_finite(v);
        stage_close(s);
    }
    stage_close(oil);
    free_volume_is_that_of_its_temperature();
    roelands_is_houperts();
    glass_of_5p4e();
    needs_where_constants_hold();
    return check_done();
}
