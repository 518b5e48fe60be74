/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares each viscosity law with values computed elsewhere and with its limits. */
#include "check.h"
#include "stage.h"

#include <flankfilm/viscosity.h>

#include <math.h>
#include <stdio.h>

static double at(stage *s, double p, double *slope)
{
    const ff_viscosity *v = stage_service(s, FF_VISCOSITY_ID);
    double ln_eta, dp;
    v->eval(v->self, 1, &p, NULL, &ln_eta, &dp, NULL);
    if (slope)
        *slope = dp;
    return ln_eta;
}

static double rise(stage *s, double p)
{
    return exp(at(s, p, NULL) - at(s, 0, NULL));
}

static stage *doolittle(double B, double K0)
{
    stage *s = stage_open("viscosity/doolittle-tait");
    stage_set(s, "eta0", 5.006e-3);
    stage_set(s, "B", B);
    stage_set(s, "V_occ", 0.6132);
    stage_set(s, "K0", K0);
    stage_set(s, "K0_prime", 10.076);
    return s;
}

/* eta/eta0 with five sets of constants at 0.2 to 1.0 GPa, and the slope at 0, published to four
   digits. */
static void doolittle_table(void)
{
    static const struct {
        double K0, B, alpha, ratio[5];
    } rows[] = {
        {1.05e9, 3.7303, 14.56, {8.416, 40.97, 170.5, 671.5, 2626}},
        {1.05e9, 4.0131, 15.67, {9.891, 54.29, 251.7, 1100, 4770}},
        {1.05e9, 4.2932, 16.76, {11.61, 71.75, 370.2, 1793, 8617}},
        {0.95e9, 3.4306, 14.80, {8.370, 40.37, 168.5, 674.4, 2718}},
        {1.15e9, 4.0265, 14.35, {8.456, 41.58, 173.1, 674.9, 2584}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        stage *s = doolittle(rows[i].B, rows[i].K0);
        double slope;
        at(s, 0, &slope);
        check_near("slope at ambient pressure, 1/GPa", 1e9 * slope, rows[i].alpha, 5e-4);
        check_near("is 4.09854 B/K0", slope, 4.09854 * rows[i].B / rows[i].K0, 2e-6);
        for (int k = 0; k < 5; k++)
            check_near("eta/eta0", rise(s, 0.2e9 * (k + 1)), rows[i].ratio[k], 6e-4);
        stage_close(s);
    }
}

static stage *roelands(const char *key, double number)
{
    stage *s = stage_open("viscosity/roelands");
    stage_set(s, "eta0", 5.006e-3);
    stage_set(s, key, number);
    return s;
}

/* z = alpha p0/(ln eta0 + 9.67), and eta(1 GPa) = 541 eta0 for the first. */
static void roelands_from_alpha(void)
{
    static const double alpha[] = {11e-9, 12e-9, 13e-9}, z[] = {0.4930, 0.5379, 0.5827};
    for (int i = 0; i < 3; i++) {
        stage *a = roelands("alpha", alpha[i]), *b = roelands("z", z[i]);
        double slope;
        at(a, 0, &slope);
        check_near("alpha is the slope at ambient pressure", slope, alpha[i], 1e-14);
        check_near("alpha and z agree", at(a, 0.5e9, NULL), at(b, 0.5e9, NULL), 5e-4);
        stage_close(a);
        stage_close(b);
    }
    stage *s = roelands("alpha", 11e-9);
    check_near("Roelands at 1 GPa, eta/eta0", rise(s, 1e9), 541, 1e-3);
    stage_close(s);
}

/* PAO-B of Larsson et al. 2000 at 40 degC: eta0 127.0 mPa s, slope 19.1/GPa, p0 = 1/5.1e-9. */
static void roelands_pao(void)
{
    stage *s = stage_open("viscosity/roelands");
    stage_set(s, "eta0", 0.1270);
    stage_set(s, "z", 0.5 - 0.071 * log10(1 + 40 / 135.));
    stage_set(s, "p0", 1 / 5.1e-9);
    double slope;
    at(s, 0, &slope);
    check_near("slope of PAO-B at 40 degC", slope, 19.1e-9, 3e-3);
    stage_close(s);
}

/* All isotherms meet in one pole, so that ln(eta/eta0) of two oils is proportional to their ln eta0
   + 9.67. */
static void roelands_isotherms(void)
{
    stage *thin = roelands("z", 0.6), *thick = stage_open("viscosity/roelands");
    stage_set(thick, "eta0", 0.5);
    stage_set(thick, "z", 0.6);
    double ratio = log(rise(thick, 0.7e9)) / log(rise(thin, 0.7e9));
    check_near("rise goes with ln eta0 + 9.67", ratio, (log(0.5) + 9.67) / (log(5.006e-3) + 9.67),
               1e-13);
    stage_close(thin);
    stage_close(thick);
}

static void barus_limits(void)
{
    stage *iso = stage_open("viscosity/isoviscous"), *flat = stage_open("viscosity/barus");
    stage *b = stage_open("viscosity/barus");
    stage_set(iso, "eta0", 0.02);
    stage_set(flat, "eta0", 0.02);
    stage_set(flat, "alpha", 0);
    stage_set(b, "eta0", 0.02);
    stage_set(b, "alpha", 20e-9);
    check_true("Barus with alpha = 0 is isoviscous", at(flat, 3e9, NULL) == at(iso, 3e9, NULL));
    check_near("Barus at 0.5 GPa", rise(b, 0.5e9), exp(10), 1e-13);
    check_near("and in tension", rise(b, -0.1e9), exp(-2), 1e-13);
    check_near("eta0 at ambient pressure", exp(at(b, 0, NULL)), 0.02, 1e-14);
    stage_close(iso);
    stage_close(flat);
    stage_close(b);
}

static stage *two_slope(double alpha_2, double width)
{
    stage *s = stage_open("viscosity/two-slope");
    stage_set(s, "eta0", 0.02);
    stage_set(s, "alpha_1", 15e-9);
    stage_set(s, "alpha_2", alpha_2);
    stage_set(s, "p_transition", 0.4e9);
    stage_set(s, "transition_width", width);
    return s;
}

/* The two lines, a kink or a bend between them, and Barus' law for equal slopes. */
static void two_slopes(void)
{
    stage *kink = two_slope(7e-9, 0), *bend = two_slope(7e-9, 0.2e9), *one = two_slope(15e-9, 0);
    double slope;
    check_near("two slopes below", rise(kink, 0.2e9), exp(3), 1e-13);
    check_near("two slopes above", rise(kink, 1e9), exp(6 + 4.2), 1e-13);
    check_near("a bend ends on the same lines", rise(bend, 0.5e9), rise(kink, 0.5e9), 1e-13);
    check_near("and begins there", rise(bend, 0.3e9), rise(kink, 0.3e9), 1e-13);
    /* the parabola in between lies below the kink by change * width/8 */
    check_near("middle of the bend", rise(bend, 0.4e9), exp(6 - 8e-9 * 0.2e9 / 8), 1e-13);
    at(bend, 0.4e9, &slope);
    check_near("slope there", slope, 11e-9, 1e-13);
    check_near("equal slopes are Barus", rise(one, 0.9e9), exp(13.5), 1e-13);
    stage_close(kink);
    stage_close(bend);
    stage_close(one);
}

/* For a nearly incompressible liquid, Doolittle-Tait becomes Barus' law with the same slope. */
static void doolittle_is_barus_when_stiff(void)
{
    stage *s = doolittle(100, 1e12);
    double slope;
    double ln_eta = at(s, 1e6, &slope);
    double alpha = 100 * 0.6132 / (0.3868 * 0.3868 * 1e12);
    check_near("slope", slope, alpha, 1e-4);
    check_near("rise", (ln_eta - at(s, 0, NULL)) / 1e6, alpha, 1e-4);
    stage_close(s);
}

int main(void)
{
    doolittle_table();
    roelands_from_alpha();
    roelands_pao();
    roelands_isotherms();
    barus_limits();
    two_slopes();
    doolittle_is_barus_when_stiff();
    return check_done();
}
