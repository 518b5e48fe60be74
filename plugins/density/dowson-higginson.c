/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dowson-Higginson: rho = rho0 [1 + a p/(1 + b p)] (Dowson & Higginson 1966). */
#include "law.h"
#include "references.h"

#include <math.h>

typedef struct dowson_higginson {
    const ff_host *host;
    ff_density service;
    double rho0; /* kg/m3; 1 with a liquid */
    const ff_liquid *liquid;
    double a, b; /* 1/Pa */
    density_softening softening;
} dowson_higginson;

FF_SIMD
static void curve(const void *self, double rho0, size_t n, const double *restrict p,
                  double *restrict rho, double *restrict drho_dp)
{
    const dowson_higginson *d = self;
    const double a = d->a, b = d->b;
    for (size_t i = 0; i < n; i++) {
        double q = p[i] > 0 ? p[i] : 0, u = 1 / (1 + b * q);
        rho[i] = rho0 * (1 + a * q * u);
        drho_dp[i] = rho0 * a * (u * u);
    }
}

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT)
{
    const dowson_higginson *d = self;
    const density_shape shape = {
        .curve = curve, .K0 = 1 / d->a, .highest = HUGE_VAL, .softening = d->softening};
    return density_eval(d, &shape, n, p, T, rho, drho_dp, drho_dT);
}

static const ff_param params[] = {
    DENSITY_RHO0_ROW(dowson_higginson, "density at ambient pressure"),
    FF_QUANTITY("a", "1/GPa", dowson_higginson, a, 0, "0.6 1/GPa", NULL, 0, 1000, 0.3, 3,
                "compressibility at ambient pressure"),
    FF_QUANTITY("b", "1/GPa", dowson_higginson, b, 0, "1.7 1/GPa", NULL, 0, 1000, 1, 5,
                "stiffening coefficient b: the relative density rise is at most a/b"),
    DENSITY_SOFTENING_ROWS(dowson_higginson, softening),
};

static ff_status ready(void *self)
{
    dowson_higginson *d = self;
    return density_softening_ready(d, &d->softening);
}

FF_DENSITY_LAW(density_dowson_higginson, dowson_higginson, eval, .id = "density/dowson-higginson",
               .version = "1.0.0",
               .summary = "density of mineral oil under pressure, with an increase of at most 35 %",
               .reference = "Dowson & Higginson 1966, Elasto-hydrodynamic Lubrication, Pergamon",
               .bibtex = BIB_DowsonHigginson1966 "\n" BIB_Anderson1967,
               .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
               .inputs = FF_TABLE(density_inputs), .wire = density_wire, .ready = ready,
               .cost = 4e-3);
