/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Roelands: ln(eta/eta0) = (ln eta0 + 9.67) [(1 + p/p0)^z - 1], eta0 in Pa s (Roelands 1966).
 * All isotherms meet at -p0, where eta = exp(-9.67) Pa s.
 */
#include "law.h"
#include "references.h"

#include <math.h>

typedef struct roelands {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
    double z, alpha, p0;
    double rise, exponent; /* ln eta0 + 9.67; z, given or found */
} roelands;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const roelands *r = self;
    const double p0 = r->p0, z = r->exponent, rise = r->rise, cap = r->oil.pressure_cap;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        double q = viscosity_clip(p[i], cap);
        double power = exp(z * log(1 + q / p0));
        double slope = rise * z * power / (p0 + q);
        ln_eta[i] = r->oil.ln_eta0 + rise * (power - 1) + slope * (p[i] - q);
        if (dln_dp)
            dln_dp[i] = slope;
    }
    return viscosity_oil_end(&r->oil, n, p, dln_dT);
}

static const ff_param params[] = {
    VISCOSITY_OIL_ROWS(roelands),
    FF_QUANTITY("z", "1", roelands, z, FF_REQUIRED, NULL, "slope", 0, 2, 0.2, 1.2,
                "pressure exponent"),
    FF_QUANTITY("alpha", "1/GPa", roelands, alpha, FF_REQUIRED, NULL, "slope", 0, 1000, 2, 50,
                "slope of ln(eta) at ambient pressure; gives z = alpha p0/(ln eta0 + 9.67)"),
    FF_QUANTITY("p0", "MPa", roelands, p0, 0, "196 MPa", NULL, 10, 1e4, 190, 200,
                "pressure constant of the law"),
};

static ff_status ready(void *self)
{
    roelands *r = self;
    ff_status status = viscosity_oil_ready(r->host, &r->oil, viscosity_highest_cap);
    if (status != FF_OK)
        return status;
    r->rise = r->oil.ln_eta0 + 9.67;
    if (r->rise <= 0)
        return ff_failf(r->host, FF_INVALID, "eta0",
                        "the Roelands law needs eta0 above exp(-9.67) = 6.3e-5 Pa s, got %g Pa s",
                        exp(r->oil.ln_eta0));
    r->exponent = isnan(r->z) ? r->alpha * r->p0 / r->rise : r->z;
    if (r->exponent > 2)
        return ff_failf(r->host, FF_INVALID, "alpha",
                        "this alpha means an exponent z of %g; at most 2 is accepted", r->exponent);
    return FF_OK;
}

FF_VISCOSITY_LAW(
    viscosity_roelands, roelands, eval, .id = "viscosity/roelands", .version = "1.0.0",
    .summary = "viscosity rise that flattens with pressure; all isotherms share one pole",
    .reference = "Roelands 1966, thesis, Technische Hogeschool Delft", .bibtex = BIB_Roelands1966,
    .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .ready = ready, .cost = 1.1e-2);
