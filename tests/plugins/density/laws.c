/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Requirements of the interface on every density law. */
#include "check.h"
#include "stage.h"

#include <difference.h>

#include <flankfilm/density.h>

#include <float.h>
#include <math.h>
#include <stdio.h>

typedef struct law {
    const char *id, *set[3][2];
    double knots[2];   /* Pa, pressures besides 0 at which the law is continued; 0: none */
    double top;        /* Pa, above which the law returns FF_DOMAIN; 0: none */
    double compliance; /* 1/Pa at ambient pressure */
} law;

static const law laws[] = {
    {"density/incompressible", {{"rho0", "900 kg/m3"}}, {0, 0}, 0, 0},
    {"density/dowson-higginson", {{"rho0", "900 kg/m3"}}, {-0.5 / 0.6e-9, 0}, 0, 0.6e-9},
    {"density/dowson-higginson",
     {{"rho0", "1 kg/m3"}, {"a", "1000 1/GPa"}, {"b", "0 1/GPa"}},
     {-0.5e6, 0},
     0,
     1e-6},
    {"density/tait",
     {{"rho0", "917.8 kg/m3"}, {"K0", "1.05 GPa"}, {"K0_prime", "10.076"}},
     {-0.525e9, 24.000325939e9},
     24.000325939e9, /* K0 [exp((1 + K0')/2) - 1]/(1 + K0') */
     1 / 1.05e9},
    {"density/tait",
     {{"rho0", "1 kg/m3"}, {"K0", "0.01 GPa"}, {"K0_prime", "0"}},
     {-0.5e7, 6.4872127e6},
     6.4872127e6,
     1e-7},
};

static stage *open_law(const law *l)
{
    stage *s = stage_open(l->id);
    for (size_t i = 0; i < 3 && l->set[i][0]; i++)
        stage_set_text(s, l->set[i][0], l->set[i][1]);
    return s;
}

static double value(const void *service, double p)
{
    const ff_density *d = service;
    double rho;
    d->eval(d->self, 1, &p, NULL, &rho, NULL, NULL);
    return rho;
}

static double slope(const ff_density *d, double p)
{
    double rho, drho_dp;
    d->eval(d->self, 1, &p, NULL, &rho, &drho_dp, NULL);
    return drho_dp;
}

static ff_status status(const ff_density *d, double p)
{
    double rho;
    return d->eval(d->self, 1, &p, NULL, &rho, NULL, NULL);
}

static const double pressures[] = {-1e12, -2e9, -0.9e9, -3e8, -4e7, -1e6, 1e6,  1e7,
                                   1e8,   5e8,  1e9,    3e9,  1e10, 5e10, 1e12, 1e15};
enum { PRESSURES = sizeof pressures / sizeof *pressures };

static void check_derivative(const ff_density *d, const law *l)
{
    double worst = 0;
    for (size_t i = 0; i < PRESSURES; i++) {
        double p = pressures[i], h = 1e-2 * (fabs(p) + 0.02 / fmax(l->compliance, 1e-9));
        h = fmin(h, 0.5 * fmin(fabs(p), fmin(fabs(p - l->knots[0]), fabs(p - l->knots[1]))));
        double rise = fabs(h * slope(d, p)) / value(d, p);
        if (rise > 1e-5) /* for smaller changes, a difference has only rounding errors */
            worst = fmax(worst, fabs(difference(value, d, p, h) / slope(d, p) - 1));
    }
    check_below("  derivative against differences", worst, 1e-8);
}

static void check_smooth(const ff_density *d, double p, double scale)
{
    double step = 1e-6 * scale, below = slope(d, p - step), above = slope(d, p + step);
    double jump = value(d, p + step) - value(d, p - step) - (above + below) * step;
    printf("  at %g Pa\n", p);
    check_below("    slope continuous", fabs(above - below), 1e-4 * fabs(below));
    check_below("    value continuous", fabs(jump),
                0.51 * fabs(above - below) * step + 1e-15 * value(d, p));
}

static void check_finite(const ff_density *d)
{
    int finite = 1, positive = 1;
    for (int e = -30; e <= 308; e++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double p = sign * pow(10, e), rho, dp, dT;
            d->eval(d->self, 1, &p, NULL, &rho, &dp, &dT);
            finite = finite && isfinite(rho) && isfinite(dp) && dT == 0;
            positive = positive && rho > 0;
        }
    check_true("  finite from 1e-30 to 1e308 Pa on both sides", finite);
    check_true("  always positive", positive && value(d, -DBL_MAX) > 0);
    check_true("  finite at the largest double", isfinite(value(d, DBL_MAX)));
}

static void check_rising(const ff_density *d)
{
    int rising = 1;
    double last = value(d, -3e9);
    for (double p = -2.99e9; p < 40e9; p += 1e7) {
        double now = value(d, p);
        rising = rising && now >= last;
        last = now;
    }
    check_true("  never falls with pressure", rising);
}

static void check_batch(const ff_density *d)
{
    double rho[PRESSURES], dp[PRESSURES], dT[PRESSURES], again[PRESSURES];
    d->eval(d->self, PRESSURES, pressures, pressures, rho, dp, dT);
    d->eval(d->self, PRESSURES, pressures, NULL, again, NULL, NULL);
    double off = 0;
    for (size_t i = 0; i < PRESSURES; i++) {
        off = fmax(off, fabs(rho[i] / value(d, pressures[i]) - 1));
        off = fmax(off, fabs(rho[i] / again[i] - 1));
        off = fmax(off, fabs(dp[i] - slope(d, pressures[i])) / fmax(dp[i], 1e-300));
    }
    check_below("  a batch equals single calls", off, 1e-14);
    check_true("  no points is a legal batch",
               d->eval(d->self, 0, NULL, NULL, NULL, NULL, NULL) == FF_OK);
}

int main(void)
{
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
        const law *l = &laws[i];
        stage *s = open_law(l);
        const ff_density *d = stage_service(s, FF_DENSITY_ID);
        printf("%s\n", l->id);
        check_true("  states its size", d->size >= sizeof *d);
        check_below("  compliance at ambient pressure",
                    fabs(slope(d, 0) / value(d, 0) - l->compliance), 1e-14 * l->compliance);
        check_derivative(d, l);
        check_smooth(d, 0, 1 / fmax(l->compliance, 1e-9));
        for (int k = 0; k < 2 && l->knots[k] != 0; k++)
            check_smooth(d, l->knots[k], fabs(l->knots[k]));
        check_finite(d);
        check_rising(d);
        check_batch(d);
        check_true("  in range in mild tension", status(d, -1e5) == FF_OK);
        if (l->compliance > 0)
            check_true("  says so in extreme tension", status(d, -1e10) == FF_DOMAIN);
        check_true("  in range below its top", status(d, 0.99 * l->top) == FF_OK);
        if (l->top > 0)
            check_true("  says so above its top", status(d, 1.01 * l->top) == FF_DOMAIN);
        stage_close(s);
    }
    return check_done();
}
