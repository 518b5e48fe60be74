/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Densities over temperature: at one temperature they are the law with the bulk modulus of it, and
   their slopes are those of central differences, whose error falls at second order. */
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
    {"density/dowson-higginson", {{"K0_decay", "0.005 1/K"}, {"at", "80 degC"}}},
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
        for (int i = 0; i < PRESSURES; i++) {
            double p = pressures[i];
            double miss = (at(d, p, T + h).rho - at(d, p, T - h).rho) / (2 * h) - at(d, p, T).by_T;
            sum += miss * miss;
        }
    return sqrt(sum);
}

/* A law at one temperature. */
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

/* Tait with K0 of that temperature, and one call for all points. */
static void is_that_of_its_temperature(void)
{
    stage *hot = open_law(&laws[1], NULL);
    const ff_density *d = stage_service(hot, FF_DENSITY_ID);
    for (double T = 290; T < 420; T += 30) {
        stage *same = stage_open("density/tait");
        double p[PRESSURES], t[PRESSURES], rho[PRESSURES], by_p[PRESSURES], worst = 0;
        stage_set_text(same, "rho0", "850 kg/m3");
        stage_set_text(same, "K0_prime", "10.076");
        stage_set(same, "K0", 1.15e9 * exp(-0.0063 * (T - 353.15)));
        const ff_density *s = stage_service(same, FF_DENSITY_ID);
        for (int i = 0; i < PRESSURES; i++)
            t[i] = T;
        memcpy(p, pressures, sizeof p);
        d->eval(d->self, PRESSURES, p, t, rho, by_p, NULL);
        for (int i = 0; i < PRESSURES; i++) {
            answer a = at(s, p[i], T);
            worst = fmax(worst, fabs(rho[i] / a.rho - 1) + fabs(by_p[i] / a.by_p - 1));
        }
        check_below("the law with K0 of its temperature", worst, 1e-12);
        stage_close(same);
    }
    stage_close(hot);
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
    for (int k = 0; k < 4; k++) {
        stage *s = open_law(&laws[k / 2], k % 2 ? oil : NULL);
        has_its_slopes(stage_service(s, FF_DENSITY_ID));
        stays_finite(stage_service(s, FF_DENSITY_ID));
        stage_close(s);
    }
    stage_close(oil);
    is_that_of_its_temperature();
    stage *without = stage_open("density/tait");
    stage_set_text(without, "rho0", "850 kg/m3");
    stage_set_text(without, "K0", "1 GPa");
    stage_set_text(without, "K0_prime", "10");
    stage_set_text(without, "K0_decay", "0.006 1/K");
    check_true("a decay from no temperature",
               stage_ready(without) == FF_INVALID && !strcmp(stage_why_item(without), "at"));
    stage_close(without);
    return check_done();
}
