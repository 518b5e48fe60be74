/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Incompressible: rho = rho0. */
#include "law.h"
#include "references.h"

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT)
{
    const density_law *law = self;
    const density_ambient ambient = density_begin(self, n, T);
    (void)p;
    for (size_t i = 0; i < n; i++) {
        rho[i] = ambient.rho0;
        if (drho_dp)
            drho_dp[i] = 0;
    }
    return density_end(law, &ambient, FF_OK, n, T, rho, drho_dp, drho_dT);
}

static const ff_param params[] = {
    DENSITY_RHO0_ROW(density_law, "density"),
};

FF_DENSITY_LAW(density_incompressible, density_law, eval, .id = "density/incompressible",
               .version = "1.0.0", .summary = "density that pressure does not change",
               .reference = "Reynolds 1886, Philosophical Transactions 177, 157-234",
               .bibtex = BIB_Reynolds1886, .licence = "GPL-3.0-or-later",
               .params = FF_TABLE(params), .inputs = FF_TABLE(density_inputs), .wire = density_wire,
               .cost = 2e-4);
