/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Barus: eta = eta0 exp(alpha p). */
#include "law.h"
#include "references.h"

typedef struct barus {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
    double alpha; /* 1/Pa */
} barus;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const barus *b = self;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = b->oil.ln_eta0 + b->alpha * p[i];
        if (dln_dp)
            dln_dp[i] = b->alpha;
    }
    return viscosity_oil_end(&b->oil, n, p, dln_dT);
}

static const ff_param params[] = {
    VISCOSITY_OIL_ROWS(barus),
    FF_QUANTITY("alpha", "1/GPa", barus, alpha, FF_REQUIRED, NULL, NULL, 0, 1000, 2, 50,
                "pressure-viscosity coefficient"),
};

static ff_status ready(void *self)
{
    barus *b = self;
    return viscosity_oil_ready(b->host, &b->oil, viscosity_highest_cap);
}

FF_VISCOSITY_LAW(
    viscosity_barus, barus, eval, .id = "viscosity/barus", .version = "1.0.0",
    .summary = "exponential rise of viscosity with pressure; too steep above some 0.5 GPa",
    .reference = "Barus 1893, American Journal of Science 45, 87-96", .bibtex = BIB_Barus1893,
    .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .ready = ready, .cost = 7e-4);
