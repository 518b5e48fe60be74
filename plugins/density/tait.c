/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Tait: rho = rho0/V, V = 1 - ln(1 + p (1 + K0')/K0) / (1 + K0'), the equation of state of the
 * Doolittle-Tait viscosity (Dymond & Malhotra 1988). From V = 1/2 on, rho goes on linearly: no
 * liquid is compressed that far, and V itself would reach 0.
 */
#include "law.h"
#include "references.h"
#include "tension.h"

#include <math.h>

typedef struct tait {
    const ff_host *host;
    ff_density service;
    double rho0; /* kg/m3; 1 with a liquid */
    const ff_liquid *liquid;
    double K0, K0_prime; /* Pa, 1 */
    double cap;          /* Pa, where V = 1/2 */
} tait;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT)
{
    const tait *d = self;
    const density_ambient ambient = density_begin(self, n, T);
    const double rho0 = ambient.rho0, K0 = d->K0, k = 1 + d->K0_prime, cap = d->cap;
    double lowest = 0, highest = 0;
    for (size_t i = 0; i < n; i++) {
        double q = fmin(fmax(p[i], 0), cap), y = 1 + fmin(p[i], 0) / K0;
        double V = 1 - log(1 + q * k / K0) / k;
        double slope = 1 / (V * V * (K0 + q * k));
        rho[i] = rho0 * (p[i] < 0 ? density_tension(y) : 1 / V + slope * (p[i] - q));
        if (drho_dp)
            drho_dp[i] = rho0 * (p[i] < 0 ? density_tension_slope(y) / K0 : slope);
        lowest = fmin(lowest, p[i]);
        highest = fmax(highest, p[i]);
    }
    int outside = 1 + lowest / K0 < 0.5 || highest > cap;
    return density_end(self, &ambient, outside ? FF_DOMAIN : FF_OK, n, T, rho, drho_dp, drho_dT);
}

static const ff_param params[] = {
    DENSITY_RHO0_ROW(tait, "density at ambient pressure"),
    FF_QUANTITY("K0", "GPa", tait, K0, FF_REQUIRED, NULL, NULL, 0.01, 1000, 0.5, 3,
                "bulk modulus at ambient pressure"),
    FF_QUANTITY("K0_prime", "1", tait, K0_prime, FF_REQUIRED, NULL, NULL, 0, 100, 8, 13,
                "rise of the bulk modulus with pressure"),
};

static ff_status ready(void *self)
{
    tait *d = self;
    double k = 1 + d->K0_prime;
    d->cap = d->K0 * expm1(k / 2) / k;
    return FF_OK;
}

FF_DENSITY_LAW(density_tait, tait, eval, .id = "density/tait", .version = "1.0.0",
               .summary = "density by the Tait equation of state",
               .reference = "Dymond & Malhotra 1988, Int. J. Thermophysics 9, 941-951",
               .bibtex = BIB_DymondMalhotra1988, .licence = "GPL-3.0-or-later",
               .params = FF_TABLE(params), .inputs = FF_TABLE(density_inputs), .wire = density_wire,
               .ready = ready, .cost = 1.3e-2);
