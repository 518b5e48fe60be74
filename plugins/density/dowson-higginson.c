/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dowson-Higginson: rho = rho0 [1 + a p/(1 + b p)] (Dowson & Higginson 1966). */
#include "tension.h"

#include <flankfilm/author.h>
#include <flankfilm/density.h>

#include <stdlib.h>

typedef struct dowson_higginson {
    ff_density service;
    double rho0, a, b; /* kg/m3, 1/Pa, 1/Pa */
} dowson_higginson;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT)
{
    const dowson_higginson *d = self;
    const double rho0 = d->rho0, a = d->a, b = d->b;
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
    {.name = "rho0",
     .unit = "kg/m3",
     .doc = "density at ambient pressure",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .min = 1,
     .max = 1e5,
     .low = 600,
     .high = 2000},
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

static const ff_port outputs[] = {
    {.name = "density", .unit = "", .doc = "the law", .dims = "", .service = FF_DENSITY_ID}};

static ff_status create(const ff_host *host, void **self)
{
    dowson_higginson *d = calloc(1, sizeof *d);
    (void)host;
    if (!d)
        return FF_NOMEM;
    d->service = (ff_density){.size = sizeof d->service, .self = d, .eval = eval};
    *self = d;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    dowson_higginson *d = self;
    double *own[] = {&d->rho0, &d->a, &d->b}; /* in the order of the rows */
    *own[param] = value->real;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    const dowson_higginson *d = self;
    (void)output;
    return &d->service;
}

static ff_status assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        ff_assessment *assessment)
{
    (void)self;
    (void)wanted;
    (void)accuracy;
    (void)in;
    return ff_assess_law(4e-3, "", assessment);
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
    .inputs = FF_NO_TABLE,
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .service = service,
    .destroy = free,
    .assess = assess,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
