/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Requirements of the interface on every viscosity law. */
#include "check.h"
#include "stage.h"

#include <difference.h>

#include <flankfilm/viscosity.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct law {
    const char *id, *set[5][2];
    double cap;   /* Pa */
    double scale; /* Pa, over which the slope changes */
} law;

static const law laws[] = {
    {"viscosity/isoviscous", {{"eta0", "5.006 mPa s"}}, 10e9, 1e8},
    {"viscosity/barus", {{"eta0", "5.006 mPa s"}, {"alpha", "11 1/GPa"}}, 10e9, 1e8},
    {"viscosity/barus", {{"eta0", "1e-30 Pa s"}, {"alpha", "1000 1/GPa"}}, 10e9, 1e8},
    {"viscosity/roelands", {{"eta0", "5.006 mPa s"}, {"z", "0.5731"}}, 10e9, 1e8},
    {"viscosity/roelands", {{"eta0", "1e6 Pa s"}, {"z", "2"}, {"p0", "10 MPa"}}, 10e9, 1e7},
    {"viscosity/roelands",
     {{"eta0", "5.006 mPa s"}, {"alpha", "11 1/GPa"}, {"pressure_cap", "2 GPa"}},
     2e9,
     1e8},
    {"viscosity/two-slope",
     {{"eta0", "5.006 mPa s"},
      {"alpha_1", "15 1/GPa"},
      {"alpha_2", "7 1/GPa"},
      {"p_transition", "0.4 GPa"}},
     10e9,
     1e8},
    {"viscosity/two-slope",
     {{"eta0", "5.006 mPa s"},
      {"alpha_1", "15 1/GPa"},
      {"alpha_2", "7 1/GPa"},
      {"p_transition", "0.4 GPa"},
      {"transition_width", "0.3 GPa"}},
     10e9,
     1e8},
    {"viscosity/two-slope",
     {{"eta0", "1 Pa s"},
      {"alpha_1", "1 1/GPa"},
      {"alpha_2", "1000 1/GPa"},
      {"p_transition", "100 GPa"},
      {"transition_width", "100 GPa"}},
     10e9,
     1e8},
    {"viscosity/doolittle-tait",
     {{"eta0", "5.006 mPa s"},
      {"B", "3.7303"},
      {"V_occ", "0.6132"},
      {"K0", "1.05 GPa"},
      {"K0_prime", "10.076"}},
     3.391182e9,
     1e8}, /* half of K0 [exp((1 - V_occ)(1 + K0')) - 1]/(1 + K0') */
    {"viscosity/doolittle-tait",
     {{"eta0", "5 mPa s"}, {"B", "100"}, {"V_occ", "0.95"}, {"K0", "0.01 GPa"}, {"K0_prime", "0"}},
     256355.4819,
     2e5},
    {"viscosity/doolittle-tait",
     {{"eta0", "5 mPa s"},
      {"B", "100"},
      {"V_occ", "0.05"},
      {"K0", "0.01 GPa"},
      {"K0_prime", "100"}},
     10e9,
     1e5},
};

static stage *open_law(const law *l)
{
    stage *s = stage_open(l->id);
    for (size_t i = 0; i < 5 && l->set[i][0]; i++)
        stage_set_text(s, l->set[i][0], l->set[i][1]);
    return s;
}

static double value(const void *service, double p)
{
    const ff_viscosity *v = service;
    double ln_eta;
    v->eval(v->self, 1, &p, NULL, &ln_eta, NULL, NULL);
    return ln_eta;
}

static double slope(const ff_viscosity *v, double p)
{
    double ln_eta, dln_dp;
    v->eval(v->self, 1, &p, NULL, &ln_eta, &dln_dp, NULL);
    return dln_dp;
}

static ff_status status(const ff_viscosity *v, double p)
{
    double ln_eta;
    return v->eval(v->self, 1, &p, NULL, &ln_eta, NULL, NULL);
}

/* Pressures on both sides of 0 and of the cap, and far beyond, in the continuation of the law. */
static const double pressures[] = {-1e30, -1e12, -5e9, -1e8, -1e5, -1.0, 1.0,  1e5,  1e7,  1e8, 3e8,
                                   6e8,   1e9,   2e9,  3e9,  5e9,  9e9,  2e10, 1e12, 1e20, 1e30};
enum { PRESSURES = sizeof pressures / sizeof *pressures };

static void check_derivative(const ff_viscosity *v, double cap, double scale)
{
    double worst = 0;
    for (size_t i = 0; i < PRESSURES; i++) {
        double p = pressures[i];
        double room = fmin(fabs(p), fabs(p - cap));
        double h = fmin(0.5 * room, p < 0 || p > cap ? HUGE_VAL : 1e-3 * (p + scale));
        double given = slope(v, p);
        /* differences near 0 have only rounding errors: the tangent there has a separate check */
        if (h * given > 1e-4)
            worst = fmax(worst, fabs(difference(value, v, p, h) / given - 1));
    }
    check_below("  derivative against differences", worst, 1e-8);
}

/* Checks that value and slope are continuous at p, where a straight line continues the law. Over a
   step, the slope may change by the curvature times the step, and the value by half of that times
   the step. */
static void check_smooth(const ff_viscosity *v, double p, double step, const char *what)
{
    double below = slope(v, p - step), above = slope(v, p + step);
    double jump = value(v, p + step) - value(v, p - step) - (above + below) * step;
    double scale = fmax(fabs(below), 1e-30);
    char text[80];
    snprintf(text, sizeof text, "  slope continuous at %s", what);
    check_below(text, fabs(above - below) / scale, 1e-4);
    snprintf(text, sizeof text, "  value continuous at %s", what);
    check_below(text, fabs(jump),
                0.51 * fabs(above - below) * step + 1e-14 * (1 + fabs(value(v, p))));
}

static void check_finite(const ff_viscosity *v)
{
    int finite = 1;
    for (int e = -30; e <= 308; e++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double p = sign * pow(10, e), ln_eta, dp, dT;
            v->eval(v->self, 1, &p, NULL, &ln_eta, &dp, &dT);
            finite = finite && isfinite(ln_eta) && isfinite(dp) && isfinite(dT);
        }
    check_true("  finite from 1e-30 to 1e308 Pa on both sides", finite);
    check_true("  finite at the largest double", isfinite(value(v, DBL_MAX)));
    check_true("  finite at the lowest double", isfinite(value(v, -DBL_MAX)));
}

static void check_rising(const ff_viscosity *v)
{
    int rising = 1;
    double last = value(v, -1e9);
    for (double p = -0.99e9; p < 15e9; p += 1e7) {
        double now = value(v, p);
        rising = rising && now >= last;
        last = now;
    }
    check_true("  never falls with pressure", rising);
}

/* Compares one call for all points, with and without optional outputs, with single calls. */
static void check_batch(const ff_viscosity *v)
{
    double ln_eta[PRESSURES], dp[PRESSURES], dT[PRESSURES], again[PRESSURES], T[PRESSURES];
    for (size_t i = 0; i < PRESSURES; i++)
        T[i] = 300 + (double)i;
    v->eval(v->self, PRESSURES, pressures, T, ln_eta, dp, dT);
    v->eval(v->self, PRESSURES, pressures, NULL, again, NULL, NULL);
    double off = 0, off_slope = 0, warm = 0;
    for (size_t i = 0; i < PRESSURES; i++) {
        double scale = fmax(fabs(ln_eta[i]), 1);
        off = fmax(off, fabs(ln_eta[i] - value(v, pressures[i])) / scale);
        off = fmax(off, fabs(ln_eta[i] - again[i]) / scale);
        off_slope = fmax(off_slope, fabs(dp[i] - slope(v, pressures[i])) / fmax(dp[i], 1e-300));
        warm = fmax(warm, fabs(dT[i]));
    }
    check_below("  a batch equals single calls", off, 1e-14);
    check_below("  so do the slopes", off_slope, 1e-14);
    check_below("  isothermal: no slope in T", warm, 0);
    check_true("  no points is a legal batch",
               v->eval(v->self, 0, NULL, NULL, NULL, NULL, NULL) == FF_OK);
}

int main(void)
{
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
        stage *s = open_law(&laws[i]);
        const ff_viscosity *v = stage_service(s, FF_VISCOSITY_ID);
        double cap = laws[i].cap;
        printf("%s\n", laws[i].id);
        check_true("  states its size", v->size >= sizeof *v);
        check_derivative(v, cap, laws[i].scale);
        check_smooth(v, 0, 1e-6 * laws[i].scale, "ambient pressure");
        check_smooth(v, cap, 1e-7 * cap, "the cap");
        check_finite(v);
        check_rising(v);
        check_batch(v);
        check_true("  in range up to the cap", status(v, 0.999 * cap) == FF_OK);
        check_true("  in range in tension", status(v, -1e8) == FF_OK);
        check_true("  says so above the cap", status(v, 1.001 * cap) == FF_DOMAIN);
        stage_close(s);
    }
    return check_done();
}
