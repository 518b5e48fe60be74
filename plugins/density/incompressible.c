/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Incompressible: rho = rho0. */
#include "law.h"
#include "references.h"

typedef struct incompressible {
    const ff_host *host;
    ff_density service;
    double rho0; /* kg/m3 */
} incompressible;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT)
{
    const incompressible *law = self;
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

static const ff_param params[] = {
    DENSITY_RHO0_ROW(incompressible, "density"),
};

FF_DENSITY_LAW(density_incompressible, incompressible, eval, .id = "density/incompressible",
               .version = "1.0.0", .summary = "density that pressure does not change",
               .reference = "Reynolds 1886, Philosophical Transactions 177, 157-234",
               .bibtex = BIB_Reynolds1886, .licence = "GPL-3.0-or-later",
               .params = FF_TABLE(params), .cost = 2e-4);
