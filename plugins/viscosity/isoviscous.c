/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Isoviscous: eta = eta0. */
#include "law.h"
#include "references.h"

typedef struct isoviscous {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
} isoviscous;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const isoviscous *v = self;
    const viscosity_ambient ambient = viscosity_oil_begin(&v->oil, n, T);
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = ambient.ln_eta0;
        if (dln_dp)
            dln_dp[i] = 0;
    }
    return viscosity_oil_end(&v->oil, &ambient, n, p, T, ln_eta, dln_dT);
}

static const ff_param params[] = {
    VISCOSITY_OIL_ROWS(isoviscous),
};

static ff_status ready(void *self)
{
    isoviscous *v = self;
    viscosity_oil_ready(&v->oil, viscosity_highest_cap);
    return FF_OK;
}

FF_VISCOSITY_LAW(viscosity_isoviscous, isoviscous, eval, .id = "viscosity/isoviscous",
                 .version = "1.0.0", .summary = "viscosity that pressure does not change",
                 .reference = "Martin 1916, Engineering 102, 119-121", .bibtex = BIB_Martin1916,
                 .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
                 .inputs = FF_TABLE(viscosity_inputs), .wire = viscosity_wire, .ready = ready,
                 .cost = 6e-4);
