/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wrong results of an oil law must be reported as errors of the law, and integrations over them
   must end. */
#include "check.h"

#include "../../../plugins/ehl/contact/liquid.h"

#include <math.h>
#include <string.h>

/* Errors of a law with 15 1/GPa. STEEP: slopes of 1e21 1/GPa. NO_NUMBER: NaN above 0.1 GPa. */
typedef enum { STEEP, NO_NUMBER } fault;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *value,
                      double *by_p, double *by_T)
{
    const fault *f = self;
    (void)T, (void)by_T;
    for (size_t i = 0; i < n; i++) {
        value[i] = -5 + 15e-9 * p[i];
        if (by_p)
            by_p[i] = *f == STEEP ? 1e12 : p[i] > 1e8 ? NAN : 15e-9;
    }
    return FF_OK;
}

static void test_steep(void)
{
    const fault steep = STEEP;
    const ff_viscosity law = {sizeof law, &steep, eval};
    numerics_answers answers = {.status = FF_OK};
    const ehl_laws laws = {.viscosity = &law, .answers = &answers};
    ehl_alpha_star(&laws);
    check_true("values that do not follow their slopes", answers.status == FF_BUG);
    check_true("of which law", !strcmp(answers.wire, "viscosity"));
}

static void test_slopes(void)
{
    const fault none = NO_NUMBER;
    const ff_viscosity viscosity = {sizeof viscosity, &none, eval};
    const ff_density density = {sizeof density, &none, eval};
    const double p[] = {0, 2e8};
    double value[2], slope[2];
    numerics_answers answers[2] = {{.status = FF_OK}, {.status = FF_OK}};
    numerics_viscosity_at viscosity_at;
    numerics_density_at density_at;
    const ff_viscosity *v = numerics_viscosity_make(&viscosity_at, &viscosity, NAN, &answers[0]);
    const ff_density *d = numerics_density_make(&density_at, &density, NAN, &answers[1]);
    check_true("the slope of a viscosity",
               v->eval(v->self, 2, p, NULL, value, slope, NULL) == FF_BUG);
    check_true("the slope of a density",
               d->eval(d->self, 2, p, NULL, value, slope, NULL) == FF_BUG);
    check_true("which",
               !strcmp(answers[1].text,
                       "it gave the slope of rho nan at 0.2 GPa; a law must give finite numbers"));
}

/* At a kink, a slope may be wrong by the difference of both sides; where the values are steep, it
   may be steep. */
static ff_status bent(const void *self, size_t n, const double *p, const double *T, double *value,
                      double *by_p, double *by_T)
{
    const double *factor = self, middle = 2e8, width = 2e3;
    (void)T, (void)by_T;
    for (size_t i = 0; i < n; i++) {
        double rise = tanh((p[i] - middle) / width), kink = p[i] < 4e8 ? 1e-9 : 2e-9;
        value[i] = -5 + rise + kink * (p[i] - 4e8);
        by_p[i] = (p[i] > 3e8 ? *factor : 1) * ((1 - rise * rise) / width + kink);
    }
    return FF_OK;
}

static numerics_answers hold_slopes(double of_viscosity, double of_density)
{
    numerics_answers answers = {.status = FF_OK};
    const ff_viscosity viscosity = {sizeof viscosity, &of_viscosity, bent};
    const ff_density density = {sizeof density, &of_density, bent};
    const ehl_laws laws = {.viscosity = &viscosity, .density = &density, .answers = &answers};
    ehl_laws_hold_slopes(&laws, 8e8);
    return answers;
}

/* Wrong slopes must be reported, since otherwise the film does not converge for no visible
   reason. */
static void test_false_slopes(void)
{
    numerics_answers none = hold_slopes(1, 1), a = hold_slopes(1e30, 1), b = hold_slopes(1, 0);
    check_true("right slopes", none.status == FF_OK);
    check_true("an absurd one", a.status == FF_BUG && !strcmp(a.wire, "viscosity"));
    check_true("its size",
               !strcmp(a.text, "ln_eta does not agree with its slope, which is 1e+30 1/GPa "
                               "at 0.3125 GPa"));
    check_true("none", b.status == FF_BUG && !strcmp(b.wire, "density"));
}

static ff_status linear(const void *self, int32_t property, size_t n, const double *T,
                        double *value, double *slope)
{
    (void)self, (void)property;
    for (size_t i = 0; i < n; i++) {
        value[i] = 2 * T[i];
        slope[i] = 2;
    }
    return FF_OK;
}

/* A temperature of NaN must not change the values at other temperatures, or get theirs. */
static void test_temperatures(void)
{
    const ff_liquid liquid = {.size = sizeof liquid, .eval = linear};
    const double T[] = {300, NAN, 300, 300};
    double value[4], slope[4];
    ff_status status = numerics_liquid_values(&liquid, FF_LIQUID_LN_ETA0, 4, T, value, slope);
    check_true("outside", status == FF_DOMAIN);
    check_near("before", value[0], 600, 0);
    check_near("there", value[1], 0, 0);
    check_near("behind", value[2], 600, 0);
    check_near("next", value[3], 600, 0);
}

int main(void)
{
    test_steep();
    test_slopes();
    test_false_slopes();
    test_temperatures();
    return check_done();
}
