/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Densities over temperature: a sum of powers, whose expansion decreases with pressure, so that the
   heat capacity at constant volume stays positive, and whose slopes must agree with central
   differences. */
#include "check.h"
#include "difference.h"
#include "stage.h"

#include <flankfilm/laws.h>

#include <float.h>
#include <math.h>
#include <string.h>

typedef struct law {
    const char *id, *set[4][2];
} law;

static const law laws[] = {
    {"density/dowson-higginson", {{"K0_decay", "0.0065 1/K"}, {"at", "80 degC"}}},
    {"density/tait",
     {{"K0", "1.15 GPa"}, {"K0_prime", "10.076"}, {"K0_decay", "0.0063 1/K"}, {"at", "80 degC"}}},
};

static stage *open_law(const law *l, stage *oil)
{
    stage *s = stage_open(l->id);
    for (int i = 0; i < 4 && l->set[i][0]; i++)
        stage_set_text(s, l->set[i][0], l->set[i][1]);
    if (oil)
        stage_link(s, "oil", oil);
    else
        stage_set_text(s, "rho0", "850 kg/m3");
    return s;
}

typedef struct answer {
    double rho, by_p, by_T;
    ff_status status;
} answer;

static answer at(const ff_density *d, double p, double T)
{
    answer a;
    a.status = d->eval(d->self, 1, &p, &T, &a.rho, &a.by_p, &a.by_T);
    return a;
}

static const double pressures[] = {-9e8, -2e8, 0, 1e7, 2e8, 9e8, 3e9, 6e10};
enum { PRESSURES = sizeof pressures / sizeof *pressures };

static double missed(const ff_density *d, double h)
{
    double sum = 0;
    for (double T = 280; T < 420; T += 10)
        for (int i = 1; i < PRESSURES; i++) { /* at the first pressure, the law leaves its
                                                 tangent */
            double p = pressures[i];
            double miss = (at(d, p, T + h).rho - at(d, p, T - h).rho) / (2 * h) - at(d, p, T).by_T;
            sum += miss * miss;
        }
    return sqrt(sum);
}

/* A density law at one temperature. */
typedef struct isotherm {
    const ff_density *law;
    double T;
} isotherm;

static double of_p(const void *ctx, double p)
{
    const isotherm *line = ctx;
    return at(line->law, p, line->T).rho;
}

static void has_its_slopes(const ff_density *d)
{
    double worst = 0;
    check_near("the error of differences over T falls at order 2", missed(d, 2) / missed(d, 1), 4,
               0.02);
    check_below("that of 0.1 K", missed(d, 0.1), missed(d, 1) / 90);
    for (double T = 280; T < 420; T += 10)
        for (int i = 0; i < PRESSURES; i++) {
            double p = pressures[i], slope = difference(of_p, &(isotherm){d, T}, p, 1e4);
            worst = fmax(worst, fabs(slope / at(d, p, T).by_p - 1));
        }
    check_below("drho_dp against differences", worst, 1e-4);
}

/* rho^n must be the sum of the thermal expansion at ambient pressure and the increase with pressure
   at `at`, (6.26). One call for all points. */
static void is_a_sum(const ff_density *d, double decay)
{
    const double hot = 353.15;
    double p[PRESSURES], t[PRESSURES], rho[PRESSURES], by_p[PRESSURES], worst = 0, parts = 0;
    answer here = at(d, 0, hot);
    double n = -decay * here.rho / here.by_T;
    for (double T = 290; T < 420; T += 30) {
        for (int i = 0; i < PRESSURES; i++)
            t[i] = T;
        memcpy(p, pressures, sizeof p);
        d->eval(d->self, PRESSURES, p, t, rho, by_p, NULL);
        for (int i = 0; i < PRESSURES; i++) {
            answer a = at(d, p[i], T), of_p = at(d, p[i], hot), ambient = at(d, 0, T);
            worst = fmax(worst, fabs(rho[i] / a.rho - 1) + fabs(by_p[i] / a.by_p - 1));
            double sum = pow(of_p.rho, n) - pow(here.rho, n) + pow(ambient.rho, n);
            parts = p[i] < 0 ? parts : fmax(parts, fabs(sum / pow(a.rho, n) - 1));
        }
    }
    check_below("points one by one", worst, 1e-12);
    check_below("of what expands and what pressure adds", parts, 1e-11);
    double near = (log(at(d, 0, hot + 1).by_p / at(d, 0, hot + 1).rho) -
                   log(at(d, 0, hot - 1).by_p / at(d, 0, hot - 1).rho)) /
                  2;
    check_near("ln K0 falls by the decay", near, decay, 2e-3);
}

/* The heat capacity at constant volume must be positive at any pressure of a film: beta^2 T/(rho c)
   must be below the compressibility. */
static void has_heat_at_constant_volume(const ff_density *d)
{
    double worst = 0, before = HUGE_VAL;
    int falls = 1;
    for (double p = 0; p < 5e9; p += 1e8) {
        answer a = at(d, p, 400);
        double beta = -a.by_T / a.rho;
        worst = fmax(worst, beta * beta * 400 / (a.rho * 2000) / (a.by_p / a.rho));
        falls &= beta > 0 && beta < before;
        before = beta;
    }
    check_below("1 - c_v/c_p", worst, 0.25);
    check_true("an expansion that falls with pressure", falls);
}

static void stays_finite(const ff_density *d)
{
    static const double T[] = {-DBL_MAX, 0, 1, 140, 1e4, DBL_MAX};
    static const double p[] = {-1e30, 0, 1e9, 1e30};
    int finite = 1;
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 4; k++) {
            answer a = at(d, p[k], T[i]);
            finite = finite && a.rho > 0 && isfinite(a.rho + a.by_p + a.by_T);
        }
    check_true("positive and finite at any temperature", finite);
}

int main(void)
{
    stage *oil = stage_open("lubricant/grade");
    stage_set_text(oil, "grade", "ISO VG 220");
    for (int k = 0; k < 2; k++) {
        stage *s = open_law(&laws[k], oil);
        const ff_density *d = stage_service(s, FF_DENSITY_ID);
        has_its_slopes(d);
        stays_finite(d);
        is_a_sum(d, k ? 0.0063 : 0.0065);
        has_heat_at_constant_volume(d);
        stage_close(s);
    }
    stage_close(oil);
    stage *without = open_law(&laws[1], NULL);
    check_true("a decay without an oil that expands", stage_ready(without) == FF_OK);
    const ff_density *cold = stage_service(without, FF_DENSITY_ID);
    const answer here = at(cold, 1e9, 300), there = at(cold, 1e9, 400);
    check_true("has no effect", here.rho == there.rho && here.by_T == 0);
    stage_close(without);
    oil = stage_open("lubricant/grade");
    stage_set_text(oil, "grade", "ISO VG 220");
    without = stage_open("density/tait");
    stage_link(without, "oil", oil);
    stage_set_text(without, "K0", "1 GPa");
    stage_set_text(without, "K0_prime", "10");
    stage_set_text(without, "K0_decay", "0.006 1/K");
    check_true("a decay from no temperature",
               stage_ready(without) == FF_INVALID && !strcmp(stage_why_item(without), "at"));
    stage_close(without);
    stage_close(oil);
    return check_done();
}
