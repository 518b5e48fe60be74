/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fluidity psi of the pressure flow: values, limits, derivatives, extremes. */
#include "check.h"
#include "stage.h"

#include <difference.h>

#include <flankfilm/rheology.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct point {
    const ff_rheology *law;
    double ln_eta, h, u_s;
} point;

typedef struct fluidity {
    double psi, dln_eta, dh;
    ff_status status;
} fluidity;

static fluidity flow(const point *at)
{
    fluidity f;
    f.status =
        at->law->flow(at->law->self, 1, &at->ln_eta, &at->h, at->u_s, &f.psi, &f.dln_eta, &f.dh);
    return f;
}

/* stress: tau0 of Ree-Eyring, G of Carreau, 0 without either */
static stage *open_law(const char *id, double stress)
{
    stage *s = stage_open(id);
    int carreau = !strcmp(id, "rheology/carreau");
    if (stress > 0)
        stage_set(s, carreau ? "G" : "tau0", stress);
    if (carreau)
        stage_set(s, "n", 0.5);
    return s;
}

static double of_ln_eta(const void *ctx, double ln_eta)
{
    point at = *(const point *)ctx;
    at.ln_eta = ln_eta;
    return flow(&at).psi;
}

static double of_h(const void *ctx, double h)
{
    point at = *(const point *)ctx;
    at.h = h;
    return flow(&at).psi;
}

static void check_derivatives(const ff_rheology *law)
{
    double worst_eta = 0, worst_h = 0;
    for (int e = -400; e <= 400; e += 25)
        for (int film = -12; film <= -3; film += 3)
            for (int speed = -3; speed <= 3; speed += 2) {
                point at = {law, e + 0.5, pow(10, film), pow(10, speed)};
                fluidity f = flow(&at);
                double d = difference(of_ln_eta, &at, at.ln_eta, 0.01);
                worst_eta = fmax(worst_eta, fabs(d - f.dln_eta) / f.psi);
                d = difference(of_h, &at, at.h, 0.01 * at.h);
                worst_h = fmax(worst_h, fabs(d - f.dh) * at.h / f.psi);
            }
    check_below("  slope in ln eta against differences", worst_eta, 1e-8);
    check_below("  slope in h against differences", worst_h, 1e-8);
}

static void check_extremes(const ff_rheology *law)
{
    static const double films[] = {5e-324, 1e-300, 1e-30, 1e-9, 1, 1e30, DBL_MAX};
    static const double speeds[] = {0, 5e-324, 1e-30, -1, 1e30, -1e300, DBL_MAX};
    static const double viscosities[] = {-DBL_MAX, -1e30, -800, -1e-30, 0, 40, 800, 1e30, DBL_MAX};
    int good = 1;
    for (size_t i = 0; i < 7; i++)
        for (size_t k = 0; k < 7; k++)
            for (size_t j = 0; j < 9; j++) {
                point at = {law, viscosities[j], films[i], speeds[k]};
                fluidity f = flow(&at);
                good = good && isfinite(f.psi) && f.psi >= 0 && isfinite(f.dln_eta) &&
                       isfinite(f.dh) && f.dln_eta <= 0 && f.dh <= 0;
            }
    check_true("  finite and of the right sign for every double", good);
    check_true("  says so where the viscosity is nothing",
               flow(&(point){law, -800, 1e-6, 1}).status == FF_DOMAIN);
    check_true("  in range for glass", flow(&(point){law, 200, 1e-6, 1}).status == FF_OK);
}

static void check_batch(const ff_rheology *law)
{
    enum { N = 37 };
    double ln_eta[N], h[N], psi[N], deta[N], dh[N], bare[N], off = 0;
    for (int i = 0; i < N; i++) {
        ln_eta[i] = -6 + i;
        h[i] = 1e-9 * (i + 1);
    }
    law->flow(law->self, N, ln_eta, h, 2.5, psi, deta, dh);
    law->flow(law->self, N, ln_eta, h, 2.5, bare, NULL, NULL);
    for (int i = 0; i < N; i++) {
        fluidity f = flow(&(point){law, ln_eta[i], h[i], 2.5});
        off = fmax(off, fabs(psi[i] - f.psi) / f.psi);
        off = fmax(off, fabs(bare[i] - f.psi) / f.psi);
        off = fmax(off, fabs(deta[i] - f.dln_eta) / f.psi);
        off = fmax(off, fabs(dh[i] - f.dh) * h[i] / f.psi);
    }
    check_below("  a batch equals single calls", off, 1e-14);
    check_true("  no points is a legal batch",
               law->flow(law->self, 0, NULL, NULL, 1, NULL, NULL, NULL) == FF_OK);
}

static void check_law(const char *id, double stress)
{
    stage *s = open_law(id, stress);
    const ff_rheology *law = stage_service(s, FF_RHEOLOGY_ID);
    printf("%s, stress %g Pa\n", id, stress);
    check_derivatives(law);
    check_extremes(law);
    check_batch(law);
    stage_close(s);
}

/* psi = cosh(asinh S)/eta wherever that does not overflow. */
static void flow_factor_identity(const ff_rheology *law, double tau0)
{
    double worst = 0, odd = 0;
    for (double ln_eta = -8; ln_eta < 100; ln_eta += 1.7)
        for (double u_s = 0.01; u_s < 50; u_s *= 3) {
            double h = 0.3e-6, S = exp(ln_eta) * u_s / (tau0 * h);
            double psi = flow(&(point){law, ln_eta, h, u_s}).psi;
            worst = fmax(worst, fabs(psi * exp(ln_eta) / cosh(asinh(S)) - 1));
            odd = fmax(odd, fabs(psi - flow(&(point){law, ln_eta, h, -u_s}).psi));
        }
    /* cosh amplifies the rounding of asinh S, up to 100, as an absolute error of its argument */
    check_below("equals cosh(asinh S)/eta", worst, 1e-13);
    check_below("even in the sliding speed", odd, 0);
}

static void limits(void)
{
    const double tau0 = 5e6;
    stage *eyring = open_law("rheology/ree-eyring", tau0);
    stage *stiff = open_law("rheology/ree-eyring", 1e30);
    stage *newton = open_law("rheology/newtonian", 0);
    const ff_rheology *e = stage_service(eyring, FF_RHEOLOGY_ID);
    const ff_rheology *k = stage_service(stiff, FF_RHEOLOGY_ID);
    const ff_rheology *n = stage_service(newton, FF_RHEOLOGY_ID);
    flow_factor_identity(e, tau0);
    for (double ln_eta = -10; ln_eta < 40; ln_eta += 10) {
        double plain = flow(&(point){n, ln_eta, 1e-7, 3}).psi;
        check_near("Newtonian is 1/eta", plain, exp(-ln_eta), 1e-15);
        check_near("no sliding: Newtonian", flow(&(point){e, ln_eta, 1e-7, 0}).psi, plain, 1e-15);
        check_near("large tau0: Newtonian", flow(&(point){k, ln_eta, 1e-7, 3}).psi, plain, 1e-15);
    }
    double solid = flow(&(point){e, 500, 1e-7, -3}).psi;
    check_near("solid: |u_s|/(tau0 h)", solid, 3 / (tau0 * 1e-7), 1e-14);
    stage_close(eyring);
    stage_close(stiff);
    stage_close(newton);
}

/* psi must be dg/dtau of the law's curve tau(g), g = u_s/h. */
static double stress_of_speed(const void *ctx, double u_s)
{
    const point *at = ctx;
    double p = 0, tau;
    at->law->shear(at->law->self, 1, &p, &at->ln_eta, &at->h, u_s, &tau);
    return tau;
}

static void slope_of_the_flow_curve(const char *id)
{
    stage *s = open_law(id, 5e6);
    double worst = 0;
    for (double ln_eta = -8; ln_eta < 30; ln_eta += 1.9)
        for (double u_s = 0.01; u_s < 50; u_s *= 3) {
            point at = {stage_service(s, FF_RHEOLOGY_ID), ln_eta, 0.3e-6, u_s};
            double slope = difference(stress_of_speed, &at, u_s, 0.01 * u_s) * at.h;
            worst = fmax(worst, fabs(slope * flow(&at).psi - 1));
        }
    printf("%s\n", id);
    check_below("  1/psi is the slope of the flow curve", worst, 1e-7);
    stage_close(s);
}

/* n = 1 is Newtonian, as is no sliding; far above G, psi = S^(1 - n)/(n eta). */
static void carreau_limits(void)
{
    stage *thick = stage_open("rheology/carreau"), *thin = open_law("rheology/carreau", 5e6);
    stage_set(thick, "G", 5e6);
    stage_set(thick, "n", 1);
    const ff_rheology *k = stage_service(thick, FF_RHEOLOGY_ID);
    const ff_rheology *c = stage_service(thin, FF_RHEOLOGY_ID);
    for (double ln_eta = -10; ln_eta < 40; ln_eta += 10) {
        check_near("n = 1: Newtonian", flow(&(point){k, ln_eta, 1e-7, 3}).psi, exp(-ln_eta), 1e-13);
        check_near("no sliding: Newtonian", flow(&(point){c, ln_eta, 1e-7, 0}).psi, exp(-ln_eta),
                   1e-13);
    }
    double S = exp(40) * 3 / (5e6 * 1e-7);
    check_near("far above G", flow(&(point){c, 40, 1e-7, -3}).psi, sqrt(S) / (0.5 * exp(40)), 1e-9);
    stage_close(thick);
    stage_close(thin);
}

int main(void)
{
    check_law("rheology/newtonian", 0);
    check_law("rheology/ree-eyring", 5e6);
    check_law("rheology/ree-eyring", 1e-30);
    check_law("rheology/ree-eyring", 1e30);
    check_law("rheology/carreau", 5e6);
    check_law("rheology/carreau", 1e-30);
    check_law("rheology/carreau", 1e30);
    slope_of_the_flow_curve("rheology/ree-eyring");
    slope_of_the_flow_curve("rheology/carreau");
    limits();
    carreau_limits();
    return check_done();
}
