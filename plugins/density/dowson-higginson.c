/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dowson-Higginson: rho = rho0 [1 + a p/(1 + b p)] (Dowson & Higginson 1966). */
#include "law.h"
#include "tension.h"

#include <stdlib.h>

typedef struct dowson_higginson {
    density_law law;
    double a, b; /* 1/Pa */
} dowson_higginson;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT)
{
    const dowson_higginson *d = self;
    const double rho0 = d->law.rho0, a = d->a, b = d->b;
    double lowest = 0;
    (void)T;
    for (size_t i = 0; i < n; i++)
        lowest = p[i] < lowest ? p[i] : lowest;
    for (size_t i = 0; i < n; i++) {
        double q = p[i] > 0 ? p[i] : 0, u = 1 / (1 + b * q);
        rho[i] = rho0 * (1 + a * q * u);
        if (drho_dp)
            drho_dp[i] = rho0 * a * (u * u);
    }
    for (size_t i = 0; i < n && lowest < 0; i++) {
        double y = 1 + a * p[i];
        if (p[i] < 0) {
            rho[i] = rho0 * density_tension(y);
            if (drho_dp)
                drho_dp[i] = rho0 * a * density_tension_slope(y);
        }
    }
    for (size_t i = 0; i < n && drho_dT; i++)
        drho_dT[i] = 0;
    return 1 + a * lowest < 0.5 ? FF_DOMAIN : FF_OK;
}

static const ff_param params[] = {
    DENSITY_RHO0_ROW("density at ambient pressure"),
    {.name = "a",
     .unit = "1/GPa",
     .doc = "compressibility at ambient pressure",
     .type = FF_REAL,
     .preset = "0.6 1/GPa",
     .max = 1000,
     .low = 0.3,
     .high = 3},
    {.name = "b",
     .unit = "1/GPa",
     .doc = "how fast it stiffens: the density rises by a/b at most",
     .type = FF_REAL,
     .preset = "1.7 1/GPa",
     .max = 1000,
     .low = 1,
     .high = 5},
};

static ff_status create(const ff_host *host, void **self)
{
    (void)host;
    return density_law_create(sizeof(dowson_higginson), 4e-3, eval, self);
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    dowson_higginson *d = self;
    double *own[] = {&d->law.rho0, &d->a, &d->b}; /* in the order of the rows */
    *own[param] = value->real;
    return FF_OK;
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "density/dowson-higginson",
    .version = "1.0.0",
    .summary = "density of mineral oil under pressure, at most 35 % denser",
    .reference = "Dowson & Higginson 1966, Elasto-hydrodynamic Lubrication, Pergamon",
    .bibtex = "@book{DowsonHigginson1966, author={Dowson, D. and Higginson, G. R.}, "
              "title={Elasto-hydrodynamic Lubrication}, publisher={Pergamon}, year={1966}}",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(density_law_outputs),
    .create = create,
    .set = set,
    .service = density_law_service,
    .destroy = free,
    .assess = density_law_assess,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
