/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Barus: eta = eta0 exp(alpha p). alpha is a parameter or, at each temperature, that of the oil. */
#include "law.h"
#include "references.h"

#include "../numerics/liquid.h"

#include <math.h>
#include <stdbool.h>

typedef struct barus {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
    viscosity_alpha own; /* alpha NaN: the pressure coefficient of the oil is used */
} barus;

/* Adds the rise of the viscosity if alpha varies with temperature. */
static ff_status add_rise(const barus *b, size_t n, const double *p, const double *T,
                          double *ln_eta, double *dln_dp, double *dln_dT)
{
    double alpha[NUMERICS_POINTS], slope[NUMERICS_POINTS];
    ff_status worst = FF_OK;
    for (size_t from = 0; from < n; from += NUMERICS_POINTS) {
        size_t count = n - from < NUMERICS_POINTS ? n - from : NUMERICS_POINTS;
        ff_status status = viscosity_alpha_values(&b->own, b->oil.liquid, count,
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
    const viscosity_ambient ambient = viscosity_oil_begin(&b->oil, n, T);
    bool moves = isnan(b->own.alpha) || b->own.slope < 0 || b->own.slope > 0;
    double alpha = moves ? 0 : b->own.alpha, slope;
    ff_status rise = FF_OK;
    bool at_once = moves && numerics_is_uniform(n, T) && !dln_dT && n > 0;
    if (at_once)
        rise = viscosity_alpha_values(&b->own, b->oil.liquid, 1, T, &alpha, &slope);
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = ambient.ln_eta0 + alpha * p[i];
        if (dln_dp)
            dln_dp[i] = alpha;
    }
    ff_status status = viscosity_oil_end(&b->oil, &ambient, n, p, T, ln_eta, dln_dT);
    if (moves && !at_once)
        rise = add_rise(b, n, p, T, ln_eta, dln_dp, dln_dT);
    return status != FF_OK ? status : rise;
}

static const ff_param params[] = {
    VISCOSITY_OIL_ROWS(barus),
    FF_QUANTITY("alpha", "1/GPa", barus, own.alpha, 0, NULL, NULL, 0, 1000, 2, 50,
                "pressure-viscosity coefficient alpha; left out: the coefficient of the oil, at "
                "each temperature"),
    VISCOSITY_ALPHA_SLOPE_ROW(barus, own.slope),
    VISCOSITY_AT_ROW(barus, own.at),
};

static ff_status ready(void *self)
{
    barus *b = self;
    viscosity_oil_ready(&b->oil, viscosity_highest_cap);
    ff_status status = viscosity_at_ready(b->host, &b->own.at, b->own.slope, "alpha_slope");
    return status == FF_OK && isnan(b->own.alpha) ? viscosity_alpha_ready(b->host, &b->oil, "")
                                                  : status;
}

FF_VISCOSITY_LAW(
    viscosity_barus, barus, eval, .id = "viscosity/barus", .version = "1.0.0",
    .summary = "exponential rise of viscosity with pressure; too steep above about 0.5 GPa",
    .reference = "Barus 1893, American Journal of Science 45, 87-96", .bibtex = BIB_Barus1893,
    .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .inputs = FF_TABLE(viscosity_inputs),
    .wire = viscosity_wire, .ready = ready, .cost = 7e-4);
