/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tait: rho = rho0/V, V = 1 - ln(1 + p (1 + K0')/K0) / (1 + K0'), the equation of state of the
   Doolittle-Tait viscosity (Dymond & Malhotra 1988). Beyond V = 1/2 rho continues linearly, since V
   would reach 0; no liquid is compressed that far. */
#include "law.h"
#include "references.h"

#include <math.h>

typedef struct tait {
    const ff_host *host;
    ff_density service;
    double rho0; /* kg/m3; 1 with a liquid */
    const ff_liquid *liquid;
    double K0, K0_prime; /* Pa, 1 */
    density_softening softening;
    double cap; /* Pa, where V = 1/2 */
} tait;

FF_SIMD
static void curve(const void *self, double rho0, size_t n, const double *restrict p,
                  double *restrict rho, double *restrict drho_dp)
{
    const tait *d = self;
    const double K0 = d->K0, k = 1 + d->K0_prime, cap = d->cap;
    for (size_t i = 0; i < n; i++) {
        double q = p[i] > 0 ? p[i] : 0;
        q = q < cap ? q : cap;
        double V = 1 - ff_log(1 + q * k / K0) / k;
        double slope = 1 / (V * V * (K0 + q * k));
        rho[i] = rho0 * (1 / V + slope * (p[i] - q));
        drho_dp[i] = rho0 * slope;
    }
}

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT)
{
    const tait *d = self;
    const density_shape shape = {
        .curve = curve, .K0 = d->K0, .highest = d->cap, .softening = d->softening};
    return density_eval(d, &shape, n, p, T, rho, drho_dp, drho_dT);
}

static const ff_param params[] = {
    DENSITY_RHO0_ROW(tait, "density at ambient pressure"),
    FF_QUANTITY("K0", "GPa", tait, K0, FF_REQUIRED, NULL, NULL, 0.01, 1000, 0.5, 3,
                "bulk modulus at ambient pressure"),
    FF_QUANTITY("K0_prime", "1", tait, K0_prime, FF_REQUIRED, NULL, NULL, 0, 100, 8, 13,
                "derivative K0' of the bulk modulus over pressure, at ambient pressure"),
    DENSITY_SOFTENING_ROWS(tait, softening),
};

static ff_status ready(void *self)
{
    tait *d = self;
    double k = 1 + d->K0_prime;
    d->cap = d->K0 * expm1(k / 2) / k;
    return density_softening_ready(d, &d->softening);
}

FF_DENSITY_LAW(density_tait, tait, eval, .id = "density/tait", .version = "1.0.0",
               .summary = "density by the Tait equation of state",
               .reference = "Dymond & Malhotra 1988, Int. J. Thermophysics 9, 941-951",
               .bibtex = BIB_DymondMalhotra1988 "\n" BIB_Anderson1967,
               .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
               .inputs = FF_TABLE(density_inputs), .wire = density_wire, .ready = ready,
               .cost = 1.3e-2);
