/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Barus: eta = eta0 exp(alpha p). */
#include "law.h"
#include "references.h"

#include "../numerics/liquid.h"

typedef struct barus {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
    double alpha; /* 1/Pa */
} barus;

/* The coefficient of the liquid changes with temperature, too. */
static ff_status add_rise(const ff_liquid *liquid, size_t n, const double *p, const double *T,
                          double *ln_eta, double *dln_dp, double *dln_dT)
{
    double alpha[NUMERICS_POINTS], slope[NUMERICS_POINTS];
    ff_status worst = FF_OK;
    for (size_t from = 0; from < n; from += NUMERICS_POINTS) {
        size_t count = n - from < NUMERICS_POINTS ? n - from : NUMERICS_POINTS;
        ff_status status = numerics_liquid_values(liquid, FF_LIQUID_PRESSURE_COEFFICIENT, count,
                                                  T ? T + from : NULL, alpha, slope);
        for (size_t i = 0; i < count; i++) {
            ln_eta[from + i] += alpha[i] * p[from + i];
            if (dln_dp)
                dln_dp[from + i] = alpha[i];
            if (dln_dT)
                dln_dT[from + i] += slope[i] * p[from + i];
        }
        worst = status != FF_OK ? status : worst;
    }
    return worst;
}

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const barus *b = self;
    const ff_liquid *liquid = b->oil.liquid;
    const double alpha = liquid ? 0 : b->alpha;
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = b->oil.ln_eta0 + alpha * p[i];
        if (dln_dp)
            dln_dp[i] = alpha;
    }
    ff_status status = viscosity_oil_end(&b->oil, n, p, T, ln_eta, dln_dT);
    ff_status rise = liquid ? add_rise(liquid, n, p, T, ln_eta, dln_dp, dln_dT) : FF_OK;
    return status != FF_OK ? status : rise;
}

static const ff_param params[] = {
    VISCOSITY_OIL_ROWS(barus),
    FF_QUANTITY_UNLESS("oil", "alpha", "1/GPa", barus, alpha, FF_REQUIRED, NULL, NULL, 0, 1000, 2,
                       50, "pressure-viscosity coefficient"),
};

static ff_status ready(void *self)
{
    barus *b = self;
    ff_status status = viscosity_alpha_ready(b->host, &b->oil);
    return status != FF_OK ? status : viscosity_oil_ready(b->host, &b->oil, viscosity_highest_cap);
}

FF_VISCOSITY_LAW(
    viscosity_barus, barus, eval, .id = "viscosity/barus", .version = "1.0.0",
    .summary = "exponential rise of viscosity with pressure; too steep above some 0.5 GPa",
    .reference = "Barus 1893, American Journal of Science 45, 87-96", .bibtex = BIB_Barus1893,
    .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .inputs = FF_TABLE(viscosity_inputs),
    .wire = viscosity_wire, .ready = ready, .cost = 7e-4);
