/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Roelands: ln(eta/eta0) = (ln eta0 + 9.67) [(1 + p/p0)^z - 1], eta0 in Pa s (Roelands 1966).
 * All isotherms meet at -p0, where eta = exp(-9.67) Pa s.
 */
#include "law.h"

#include <math.h>

typedef struct roelands {
    viscosity_law law;
    double z, alpha, p0;
    double rise; /* ln eta0 + 9.67 */
} roelands;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const roelands *r = self;
    const double p0 = r->p0, z = r->z, rise = r->rise, cap = r->law.pressure_cap;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        double q = viscosity_law_clip(p[i], cap);
        double power = exp(z * log(1 + q / p0));
        double slope = rise * z * power / (p0 + q);
        ln_eta[i] = r->law.ln_eta0 + rise * (power - 1) + slope * (p[i] - q);
        if (dln_dp)
            dln_dp[i] = slope;
    }
    return viscosity_law_end(&r->law, n, p, dln_dT);
}

static const ff_param params[] = {
    VISCOSITY_LAW_ROWS,
    {.name = "z",
     .unit = "1",
     .type = FF_REAL,
     .doc = "pressure exponent",
     .flags = FF_REQUIRED,
     .group = "slope",
     .max = 2,
     .low = 0.2,
     .high = 1.2},
    {.name = "alpha",
     .unit = "1/GPa",
     .type = FF_REAL,
     .doc = "slope of ln(eta) at ambient pressure; gives z = alpha p0/(ln eta0 + 9.67)",
     .flags = FF_REQUIRED,
     .group = "slope",
     .max = 1000,
     .low = 2,
     .high = 50},
    {.name = "p0",
     .unit = "MPa",
     .type = FF_REAL,
     .doc = "pressure constant of the law",
     .preset = "196 MPa",
     .min = 10,
     .max = 1e4,
     .low = 190,
     .high = 200},
};

static ff_status create(const ff_host *host, void **self)
{
    return viscosity_law_create(host, sizeof(roelands), 1.1e-2, eval, self);
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    roelands *r = self;
    double *own[] = {&r->z, &r->alpha, &r->p0}; /* in the order of the rows */
    if (param < VISCOSITY_LAW_PARAMS)
        return viscosity_law_set(&r->law, param, value);
    *own[param - VISCOSITY_LAW_PARAMS] = value->real;
    return FF_OK;
}

static ff_status ready(void *self)
{
    roelands *r = self;
    ff_status status = viscosity_law_ready(&r->law, viscosity_highest_cap);
    if (status != FF_OK)
        return status;
    r->rise = r->law.ln_eta0 + 9.67;
    if (r->rise <= 0)
        return ff_failf(r->law.host, FF_INVALID, "eta0",
                        "the Roelands law needs eta0 above exp(-9.67) = 6.3e-5 Pa s, got %g Pa s",
                        exp(r->law.ln_eta0));
    if (r->alpha > 0)
        r->z = r->alpha * r->p0 / r->rise;
    if (r->z > 2)
        return ff_failf(r->law.host, FF_INVALID, "alpha",
                        "this alpha means an exponent z of %g; at most 2 is accepted", r->z);
    return FF_OK;
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "viscosity/roelands",
    .version = "1.0.0",
    .summary = "viscosity rise that flattens with pressure; all isotherms share one pole",
    .reference = "Roelands 1966, thesis, Technische Hogeschool Delft",
    .bibtex =
        "@phdthesis{Roelands1966, author={Roelands, C. J. A.}, title={Correlational aspects of "
        "the viscosity-temperature-pressure relationship of lubricating oils}, "
        "school={Technische Hogeschool Delft}, year={1966}}",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(viscosity_law_outputs),
    .create = create,
    .set = set,
    .ready = ready,
    .service = viscosity_law_service,
    .destroy = viscosity_law_destroy,
    .assess = viscosity_law_assess,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
