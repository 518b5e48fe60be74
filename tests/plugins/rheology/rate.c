/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shear rate over stress at a point: it must be the inverse of the mean stress; its slope must be
   the fluidity psi at small pressure gradients; and integrated across a film, it must agree with
   the mean laws, to second order in h dp/dx over the stress of shear thinning. */
#include "check.h"
#include "stage.h"

#include <difference.h>

#include <flankfilm/laws.h>

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

typedef struct stressed {
    const char *id, *stress;
    double value, n;
} stressed;

static const stressed laws[] = {
    {"rheology/newtonian", NULL, 0, 0},       {"rheology/ree-eyring", "tau0", 5e6, 0},
    {"rheology/ree-eyring", "tau0", 1e-3, 0}, {"rheology/carreau", "G", 6e6, 0.42},
    {"rheology/carreau", "G", 6e6, 1},        {"rheology/carreau", "G", 1e5, 0.05},
};

static stage *open_law(const stressed *l)
{
    stage *s = stage_open(l->id);
    if (l->stress)
        stage_set(s, l->stress, l->value);
    if (l->n > 0)
        stage_set(s, "n", l->n);
    return s;
}

typedef struct point {
    const ff_rheology_2 *law;
    double p, ln_eta, tau;
} point;

typedef struct sheared {
    double rate, by_tau, by_ln_eta;
    ff_status status;
} sheared;

static sheared at(const point *q)
{
    sheared s;
    s.status = q->law->rate(q->law->self, 1, &q->p, NULL, &q->ln_eta, &q->tau, &s.rate, &s.by_tau,
                            &s.by_ln_eta);
    return s;
}

static double of_tau(const void *ctx, double tau)
{
    point q = *(const point *)ctx;
    q.tau = tau;
    return at(&q).rate;
}

static double of_ln_eta(const void *ctx, double ln_eta)
{
    point q = *(const point *)ctx;
    q.ln_eta = ln_eta;
    return at(&q).rate;
}

/* Checks slopes from 1e-3 to 1e3 times the stress of shear thinning, and beyond the limit of the
   rate, at very high and very low viscosity. */
static void check_slopes(const ff_rheology_2 *law, double stress, bool power)
{
    double worst_tau = 0, worst_eta = 0;
    for (int l = -150; l <= 400; l += 22)
        for (int e = -10; e <= 10; e++) {
            point q = {law, 1e9, l + 0.3, 1.3 * stress * pow(2, e)};
            sheared s = at(&q);
            double step = 2e-3 * (power ? q.tau : fmin(q.tau, stress)),
                   d = difference(of_tau, &q, q.tau, step);
            point last = q; /* differences across the limit contain its kink */
            last.tau += step;
            if (at(&last).status == s.status)
                worst_tau = fmax(worst_tau, fabs(d / s.by_tau - 1));
            d = difference(of_ln_eta, &q, q.ln_eta, 1e-3);
            worst_eta = fmax(worst_eta, fabs(d - s.by_ln_eta) / s.rate);
        }
    check_below("  slope in tau against differences", worst_tau, 1e-8);
    check_below("  slope in ln eta against differences", worst_eta, 1e-8);
}

/* The rate at the mean stress must be u_s/h, and its slope psi. */
static void check_inverse(const ff_rheology *mean, const ff_rheology_2 *law)
{
    double worst = 0, worst_psi = 0, p = 1e9;
    for (int l = -6; l <= 30; l += 3)
        for (int film = -8; film <= -5; film++)
            for (int speed = -6; speed <= 2; speed++) {
                double ln_eta = l, h = pow(10, film), u_s = pow(10, speed), tau, psi;
                mean->shear(mean->self, 1, &p, &ln_eta, &h, u_s, &tau);
                mean->flow(mean->self, 1, &ln_eta, &h, u_s, &psi, NULL, NULL);
                point q = {law, p, ln_eta, tau};
                sheared s = at(&q);
                worst = fmax(worst, fabs(s.rate * h / u_s - 1));
                worst_psi = fmax(worst_psi, fabs(s.by_tau / psi - 1));
            }
    check_below("  it is the inverse of the mean stress", worst, 1e-11);
    check_below("  its slope is the fluidity of the pressure flow", worst_psi, 1e-11);
}

/* Returns the integral of z^order rate(tau_m + z gradient) over a film of thickness 1 around z = 0,
   and its slope by tau_m, by Simpson's rule. */
static double across(const ff_rheology_2 *law, double ln_eta, double tau_m, double gradient,
                     int order, double *slope)
{
    enum { STEPS = 400 };
    double sum = 0;
    *slope = 0;
    for (int i = 0; i <= STEPS; i++) {
        double z = (double)i / STEPS - 0.5, weight = i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2;
        point q = {law, 1e9, ln_eta, tau_m + z * gradient};
        sheared s = at(&q);
        weight *= pow(z, order) / (3.0 * STEPS);
        sum += weight * s.rate;
        *slope += weight * s.by_tau;
    }
    return sum;
}

/* Returns the pressure flow in a film of thickness 1 whose walls slide at u_s, over that of the
   mean law: int u dz = -int z rate dz if the mean velocity of both walls is 0. */
static double flow_ratio(stage *s, double ln_eta, double u_s, double gradient)
{
    const ff_rheology *mean = stage_service(s, FF_RHEOLOGY_ID);
    const ff_rheology_2 *law = stage_service(s, FF_RHEOLOGY_2_ID);
    double p = 1e9, h = 1, tau, psi, slope, by_tau;
    mean->shear(mean->self, 1, &p, &ln_eta, &h, u_s, &tau);
    mean->flow(mean->self, 1, &ln_eta, &h, u_s, &psi, NULL, NULL);
    for (int i = 0; i < 60; i++) {
        double off = across(law, ln_eta, tau, gradient, 0, &by_tau) - u_s;
        tau -= off / by_tau;
    }
    return across(law, ln_eta, tau, gradient, 1, &slope) / (gradient * psi / 12);
}

/* Second order: half the gradient must give a quarter of the difference. */
static void check_limit(stage *s, double stress, double n)
{
    double gradient = 0.2 * stress * (n > 0 ? n : 1);
    for (int k = 0; k < 3; k++) {
        double S = (double[]){0, 1, 10}[k], u_s = S * stress * exp(-5);
        double whole = flow_ratio(s, 5, u_s, gradient) - 1;
        double half = flow_ratio(s, 5, u_s, gradient / 2) - 1;
        if (fabs(whole) > 1e-9)
            check_near("  differences from the mean law fall as the gradient squared", whole / half,
                       4, 0.05);
        else
            check_below("  no difference from the mean law", fabs(whole), 1e-9);
    }
}

/* Ratios of pressure flows by Ree-Eyring's law at h (dp/dx)/(2 tau0) = x: for walls at rest, 3 (x
   cosh x - sinh x)/x^3. */
static void eyring_at_large_gradients(void)
{
    stage *s = open_law(&laws[1]);
    for (int k = 0; k < 3; k++) {
        double x = (double[]){0.5, 1, 2}[k];
        check_near("at rest", flow_ratio(s, 3, 0, 2 * x * 5e6),
                   3 * (x * cosh(x) - sinh(x)) / (x * x * x), 1e-8);
    }
    stage_close(s);
}

static void check_extremes(const ff_rheology_2 *law)
{
    static const double stresses[] = {0, 5e-324, 1e-30, -1, 1e30, -1e300, DBL_MAX, -DBL_MAX};
    static const double viscosities[] = {-DBL_MAX, -1e30, -800, -1e-30, 0, 40, 800, 1e30, DBL_MAX};
    static const double pressures[] = {-DBL_MAX, -1, 0, 1e9, DBL_MAX};
    int finite = 1, sign = 1;
    for (size_t i = 0; i < 8; i++)
        for (size_t j = 0; j < 9; j++)
            for (size_t k = 0; k < 5; k++) {
                point q = {law, pressures[k], viscosities[j], stresses[i]};
                sheared s = at(&q);
                finite = finite && isfinite(s.rate) && isfinite(s.by_tau) && isfinite(s.by_ln_eta);
                sign = sign && s.rate * copysign(1, q.tau) >= 0 && s.by_tau >= 0;
            }
    check_true("  finite for every double", finite);
    check_true("  with the sign of the stress, and rising", sign);
    point q = {law, 1e9, 0, 0};
    check_true("  none without stress", at(&q).rate == 0);
    check_true("  no points is a legal batch",
               law->rate(law->self, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL) == FF_OK);
}

/* With a limiting stress, the film slips with 1e7 1/s at 1 % above it, and not at 1 % below. */
static void slips_at_the_limit(void)
{
    static const size_t which[] = {0, 1, 3};
    for (size_t k = 0; k < 3; k++) {
        stage *s = open_law(&laws[which[k]]), *plain = open_law(&laws[which[k]]);
        stage_set(s, "limiting_stress_coefficient", 0.05);
        point q = {stage_service(s, FF_RHEOLOGY_2_ID), 1e9, 20, 1.01 * 50e6};
        point o = q, low = q;
        o.law = stage_service(plain, FF_RHEOLOGY_2_ID);
        check_near("slip at 1 % above the limit", at(&q).rate - at(&o).rate, 1e7, 1e-9);
        check_near("its slope", at(&q).by_tau - at(&o).by_tau, 2e9 / 50e6, 1e-9);
        q.tau = o.tau = 0.99 * 50e6;
        check_true("none below", at(&q).rate == at(&o).rate);
        low.p = 0;
        low.tau = 3.9e6;
        o = low;
        o.law = stage_service(plain, FF_RHEOLOGY_2_ID);
        check_true("none in the inlet", at(&low).rate == at(&o).rate);
        stage_close(s);
        stage_close(plain);
    }
}

int main(void)
{
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
        stage *s = open_law(&laws[i]);
        double stress = laws[i].stress ? laws[i].value : 1e6;
        printf("%s %g\n", laws[i].id, stress);
        check_slopes(stage_service(s, FF_RHEOLOGY_2_ID), stress, laws[i].n > 0);
        check_inverse(stage_service(s, FF_RHEOLOGY_ID), stage_service(s, FF_RHEOLOGY_2_ID));
        check_limit(s, stress, laws[i].n);
        check_extremes(stage_service(s, FF_RHEOLOGY_2_ID));
        stage_close(s);
    }
    eyring_at_large_gradients();
    slips_at_the_limit();
    return check_done();
}
