/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Tait: rho = rho0/V, V = 1 - ln(1 + p (1 + K0')/K0) / (1 + K0'), the equation of state of the
 * Doolittle-Tait viscosity (Dymond & Malhotra 1988). From V = 1/2 on, rho goes on linearly: no
 * liquid is compressed that far, and V itself would reach 0.
 */
#include "law.h"
#include "tension.h"

#include <math.h>
#include <stdlib.h>

typedef struct tait {
    density_law law;
    double K0, K0_prime; /* Pa, 1 */
    double cap;          /* Pa, where V = 1/2 */
} tait;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT)
{
    const tait *d = self;
    const double rho0 = d->law.rho0, K0 = d->K0, k = 1 + d->K0_prime, cap = d->cap;
    double lowest = 0, highest = 0;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        double q = fmin(fmax(p[i], 0), cap), y = 1 + fmin(p[i], 0) / K0;
        double V = 1 - log(1 + q * k / K0) / k;
        double slope = 1 / (V * V * (K0 + q * k));
        rho[i] = rho0 * (p[i] < 0 ? density_tension(y) : 1 / V + slope * (p[i] - q));
        if (drho_dp)
            drho_dp[i] = rho0 * (p[i] < 0 ? density_tension_slope(y) / K0 : slope);
        if (drho_dT)
            drho_dT[i] = 0;
        lowest = fmin(lowest, p[i]);
        highest = fmax(highest, p[i]);
    }
    return 1 + lowest / K0 < 0.5 || highest > cap ? FF_DOMAIN : FF_OK;
}

static const ff_param params[] = {
    DENSITY_RHO0_ROW("density at ambient pressure"),
    {.name = "K0",
     .unit = "GPa",
     .doc = "bulk modulus at ambient pressure",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .min = 0.01,
     .max = 1000,
     .low = 0.5,
     .high = 3},
    {.name = "K0_prime",
     .unit = "1",
     .doc = "rise of the bulk modulus with pressure",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .max = 100,
     .low = 8,
     .high = 13},
};

static ff_status create(const ff_host *host, void **self)
{
    (void)host;
    return density_law_create(sizeof(tait), 1.3e-2, eval, self);
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    tait *d = self;
    double *own[] = {&d->law.rho0, &d->K0, &d->K0_prime}; /* in the order of the rows */
    *own[param] = value->real;
    return FF_OK;
}

static ff_status ready(void *self)
{
    tait *d = self;
    double k = 1 + d->K0_prime;
    d->cap = d->K0 * expm1(k / 2) / k;
    return FF_OK;
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "density/tait",
    .version = "1.0.0",
    .summary = "density by the Tait equation of state",
    .reference = "Dymond & Malhotra 1988, Int. J. Thermophysics 9, 941-951",
    .bibtex =
        "@article{DymondMalhotra1988, author={Dymond, J. H. and Malhotra, R.}, title={The {Tait} "
        "equation: 100 years on}, journal={International Journal of Thermophysics}, "
        "volume={9}, pages={941--951}, year={1988}}",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(density_law_outputs),
    .create = create,
    .set = set,
    .ready = ready,
    .service = density_law_service,
    .destroy = free,
    .assess = density_law_assess,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
