/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Incompressible: rho = rho0. */
#include "law.h"

#include <stdlib.h>

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT)
{
    const density_law *law = self;
    (void)p;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        rho[i] = law->rho0;
        if (drho_dp)
            drho_dp[i] = 0;
        if (drho_dT)
            drho_dT[i] = 0;
    }
    return FF_OK;
}

static const ff_param params[] = {DENSITY_RHO0_ROW("density")};

static ff_status create(const ff_host *host, void **self)
{
    (void)host;
    return density_law_create(sizeof(density_law), 2e-4, eval, self);
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    density_law *law = self;
    (void)param;
    law->rho0 = value->real;
    return FF_OK;
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
