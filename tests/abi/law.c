/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A law as it was compiled against the headers of an older interface: ln eta = ln eta0 + alpha p.
 */
#include <flankfilm/author.h>
#include <flankfilm/viscosity.h>

#include <math.h>
#include <stdlib.h>

#ifndef FROZEN_MINOR
#error "FROZEN_MINOR is the minor version of the headers"
#elif FF_ABI_MINOR != FROZEN_MINOR
#error "these are the headers of another version"
#endif

typedef struct law {
    ff_viscosity service;
    double ln_eta0, alpha;
} law;

static const ff_param params[] = {
    {.name = "eta0",
     .unit = "mPa s",
     .doc = "viscosity at ambient pressure",
     .type = FF_REAL,
     .flags = FF_REQUIRED | FF_MIN_OPEN,
     .max = 1e9,
     .low = 1,
     .high = 1000},
    {.name = "alpha",
     .unit = "1/GPa",
     .doc = "pressure coefficient",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .max = 100,
     .low = 2,
     .high = 50},
};

static const ff_port outputs[] = {
    {.name = "viscosity", .unit = "", .doc = "eta(p)", .dims = "", .service = FF_VISCOSITY_ID}};

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const law *l = self;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = l->ln_eta0 + l->alpha * p[i];
        if (dln_dp)
            dln_dp[i] = l->alpha;
        if (dln_dT)
            dln_dT[i] = 0;
    }
    return FF_OK;
}

static ff_status create(const ff_host *host, void **self)
{
    law *l = calloc(1, sizeof *l);
    if (!l)
        return host->fail(host->ctx, FF_NOMEM, NULL, "out of memory");
    l->service = (ff_viscosity){.size = sizeof l->service, .self = l, .eval = eval};
    *self = l;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    law *l = self;
    *(param == 0 ? &l->ln_eta0 : &l->alpha) = param == 0 ? log(value->real) : value->real;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    (void)output;
    return &((law *)self)->service;
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "viscosity/" FROZEN_NAME,
    .version = "1.0.0",
    .summary = "a law of an older interface",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .service = service,
    .destroy = free,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
