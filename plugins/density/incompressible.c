/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Incompressible: rho = rho0. */
#include <flankfilm/author.h>
#include <flankfilm/density.h>

#include <stdlib.h>

typedef struct incompressible {
    ff_density service;
    double rho0; /* kg/m3 */
} incompressible;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT)
{
    const incompressible *d = self;
    (void)p;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        rho[i] = d->rho0;
        if (drho_dp)
            drho_dp[i] = 0;
        if (drho_dT)
            drho_dT[i] = 0;
    }
    return FF_OK;
}

static const ff_param params[] = {{.name = "rho0",
                                   .unit = "kg/m3",
                                   .doc = "density",
                                   .type = FF_REAL,
                                   .flags = FF_REQUIRED,
                                   .min = 1,
                                   .max = 1e5,
                                   .low = 600,
                                   .high = 2000}};

static const ff_port outputs[] = {
    {.name = "density", .unit = "", .doc = "the law", .dims = "", .service = FF_DENSITY_ID}};

static ff_status create(const ff_host *host, void **self)
{
    incompressible *d = calloc(1, sizeof *d);
    (void)host;
    if (!d)
        return FF_NOMEM;
    d->service = (ff_density){.size = sizeof d->service, .self = d, .eval = eval};
    *self = d;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    incompressible *d = self;
    (void)param;
    d->rho0 = value->real;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    const incompressible *d = self;
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
    return ff_assess_law(2e-4, "", assessment);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "density/incompressible",
    .version = "1.0.0",
    .summary = "density that pressure does not change",
    .reference = "Reynolds 1886, Philosophical Transactions 177, 157-234",
    .bibtex = "@article{Reynolds1886, author={Reynolds, O.}, title={On the theory of lubrication "
              "and its application to Mr. Beauchamp Tower's experiments}, journal={Philosophical "
              "Transactions of the Royal Society of London}, volume={177}, pages={157--234}, "
              "year={1886}}",
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
