/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Doolittle free volume with the Tait equation of state (Li & Kahraman 2011, eqs 11a, 11b):
 *   V = 1 - ln(1 + p (1 + K0')/K0) / (1 + K0')
 *   ln(eta/eta0) = B V_occ (1 - V) / [(V - V_occ) (1 - V_occ)]
 * It has a pole where V falls to the occupied volume V_occ; the cap stays away from it.
 */
#include "law.h"
#include "references.h"

#include <math.h>

typedef struct doolittle_tait {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
    double B, V_occ, K0, K0_prime;
} doolittle_tait;

FF_SIMD
static void curve(const void *self, double ln_eta0, size_t n, const double *restrict p,
                  double *restrict ln_eta, double *restrict dln_dp)
{
    const doolittle_tait *d = self;
    const double B = d->B, V_occ = d->V_occ, K0 = d->K0, k = 1 + d->K0_prime;
    const double cap = d->oil.pressure_cap;
    for (size_t i = 0; i < n; i++) {
        double q = viscosity_clip(p[i], cap);
        double shrinkage = ff_log(1 + q * k / K0) / k; /* 1 - V */
        double free = 1 - shrinkage - V_occ;           /* V - V_occ */
        double scale = B * V_occ / free;
        double slope = scale / free / (K0 + q * k);
        ln_eta[i] = ln_eta0 + scale * shrinkage / (1 - V_occ) + slope * (p[i] - q);
        dln_dp[i] = slope;
    }
}

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    return viscosity_eval(self, curve, n, p, T, ln_eta, dln_dp, dln_dT);
}

static const ff_param params[] = {
    VISCOSITY_OIL_ROWS(doolittle_tait),
    FF_QUANTITY("B", "1", doolittle_tait, B, FF_REQUIRED, NULL, NULL, 0, 100, 1, 10,
                "Doolittle's constant"),
    FF_QUANTITY("V_occ", "1", doolittle_tait, V_occ, FF_REQUIRED, NULL, NULL, 0.05, 0.95, 0.5, 0.8,
                "occupied volume over the volume at ambient pressure"),
    FF_QUANTITY("K0", "GPa", doolittle_tait, K0, FF_REQUIRED, NULL, NULL, 0.01, 1000, 0.5, 3,
                "bulk modulus at ambient pressure"),
    FF_QUANTITY("K0_prime", "1", doolittle_tait, K0_prime, FF_REQUIRED, NULL, NULL, 0, 100, 8, 13,
                "rise of the bulk modulus with pressure"),
};

static ff_status ready(void *self)
{
    doolittle_tait *d = self;
    double k = 1 + d->K0_prime;
    double pole = d->K0 * expm1((1 - d->V_occ) * k) / k; /* V = V_occ */
    viscosity_oil_ready(&d->oil, fmin(viscosity_highest_cap, pole / 2));
    if (d->oil.pressure_cap > 0.9 * pole)
        return ff_failf(d->host, FF_INVALID, "pressure_cap",
                        "the free volume ends at %g GPa; the cap must be below 0.9 of that",
                        1e-9 * pole);
    return FF_OK;
}

FF_VISCOSITY_LAW(
    viscosity_doolittle_tait, doolittle_tait, eval, .id = "viscosity/doolittle-tait",
    .version = "1.0.0",
    .summary = "free-volume law: steep at ambient pressure, flatter, then steep again",
    .reference =
        "Doolittle 1951, J. Appl. Phys. 22, 1471-1475; Li & Kahraman 2011, Proc. IMechE J, 740-753",
    .bibtex = BIB_Doolittle1951 "\n" BIB_LiKahraman2011, .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params), .inputs = FF_TABLE(viscosity_inputs), .wire = viscosity_wire,
    .ready = ready, .cost = 8e-3);
