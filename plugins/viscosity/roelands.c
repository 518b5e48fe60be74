/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Roelands: ln(eta/eta0) = (ln eta0 + 9.67) [(1 + p/p0)^z - 1], eta0 in Pa s (Roelands 1966).
 * All isotherms meet at p = -p0, where eta = exp(-9.67) Pa s. With temperature (Houpert 1985),
 * the factor ln eta0 + 9.67 follows from the oil, or without an oil decreases by [(T - 138)/(at
 * - 138)]^-s0, T in K. */
#include "law.h"
#include "references.h"

#include "../numerics/liquid.h"

#include <math.h>
#include <stdbool.h>

typedef struct roelands {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
    double z, p0;
    viscosity_alpha own;   /* alpha NaN: not given */
    double s0;             /* 0 if an oil is wired */
    double rise, exponent; /* ln eta0 + 9.67, and z, given or derived */
    bool thermal;          /* the law depends on temperature */
} roelands;

/* The rise L = ln eta0 + 9.67 and the exponent z at the temperature of a point, with slopes over T.
   If z is not given, z = alpha p0/L. */
typedef struct isotherm {
    double rise, rise_T, z, z_T;
} isotherm;

static void at_point(const roelands *r, const isotherm *at, double p, double out[3])
{
    double q = viscosity_clip(p, r->oil.pressure_cap), ln = log(1 + q / r->p0);
    double power = exp(at->z * ln), steep = at->rise * power / (r->p0 + q);
    double power_T = power * ln * at->z_T;
    double slope_T =
        at->z * (at->rise_T * power + at->rise * power_T) / (r->p0 + q) + at->z_T * steep;
    out[0] = at->rise - 9.67 + at->rise * (power - 1) + at->z * steep * (p - q);
    out[1] = at->z * steep;
    out[2] = at->rise_T * power + at->rise * power_T + slope_T * (p - q);
}

/* ln eta0 and its slope over T at n <= NUMERICS_POINTS points. */
static ff_status ambient_values(const roelands *r, size_t n, const double *T, double *ln,
                                double *slope)
{
    if (r->oil.liquid)
        return numerics_liquid_values(r->oil.liquid, FF_LIQUID_LN_ETA0, n, T, ln, slope);
    for (size_t i = 0; i < n; i++) {
        double t = T ? T[i] : r->own.at, in = viscosity_temperature(t);
        double factor = pow((in - 138) / (r->own.at - 138), -r->s0);
        ln[i] = r->rise * factor - 9.67;
        slope[i] = in < t || in > t ? 0 : -r->s0 * r->rise * factor / (in - 138);
    }
    return FF_OK;
}

static ff_status eval_some(const roelands *r, size_t n, const double *p, const double *T,
                           double *ln_eta, double *dln_dp, double *dln_dT)
{
    double ln[NUMERICS_POINTS], ln_T[NUMERICS_POINTS], alpha[NUMERICS_POINTS],
        alpha_T[NUMERICS_POINTS];
    ff_status worst = ambient_values(r, n, T, ln, ln_T);
    if (isnan(r->z)) {
        ff_status status = viscosity_alpha_values(&r->own, r->oil.liquid, n, T, alpha, alpha_T);
        worst = status != FF_OK ? status : worst;
    }
    for (size_t i = 0; i < n; i++) {
        isotherm at = {.rise = fmax(ln[i] + 9.67, 0.1), .z = r->z};
        at.rise_T = ln[i] + 9.67 > 0.1 ? ln_T[i] : 0;
        if (isnan(r->z)) {
            at.z = alpha[i] * r->p0 / at.rise;
            at.z_T = (alpha_T[i] * r->p0 - at.z * at.rise_T) / at.rise;
        }
        double out[3];
        at_point(r, &at, p[i], out);
        ln_eta[i] = out[0];
        if (dln_dp)
            dln_dp[i] = out[1];
        if (dln_dT)
            dln_dT[i] = out[2];
        worst = p[i] > r->oil.pressure_cap ? FF_DOMAIN : worst;
    }
    return worst;
}

static ff_status eval_thermal(const roelands *r, size_t n, const double *p, const double *T,
                              double *ln_eta, double *dln_dp, double *dln_dT)
{
    ff_status worst = FF_OK;
    for (size_t from = 0; from < n; from += NUMERICS_POINTS) {
        size_t count = n - from < NUMERICS_POINTS ? n - from : NUMERICS_POINTS;
        ff_status status = eval_some(r, count, p + from, T ? T + from : NULL, ln_eta + from,
                                     dln_dp ? dln_dp + from : NULL, dln_dT ? dln_dT + from : NULL);
        worst = status != FF_OK ? status : worst;
    }
    return worst;
}

/* Sets rise and exponent for the common temperature of all points. */
static ff_status take_isotherm(const roelands *r, const double *T, double *rise, double *z)
{
    double ln, alpha = NAN, slope;
    ff_status status = ambient_values(r, 1, T, &ln, &slope);
    if (isnan(r->z)) {
        ff_status other = viscosity_alpha_values(&r->own, r->oil.liquid, 1, T, &alpha, &slope);
        status = other != FF_OK ? other : status;
    }
    *rise = fmax(ln + 9.67, 0.1);
    *z = isnan(r->z) ? alpha * r->p0 / *rise : r->z;
    return status;
}

/* The law at a single temperature. */
typedef struct isothermal {
    double rise, z, p0, cap;
} isothermal;

FF_SIMD
static void curve(const void *law, double ln_eta0, size_t n, const double *restrict p,
                  double *restrict ln_eta, double *restrict dln_dp)
{
    const isothermal *at = law;
    const double rise = at->rise, z = at->z, p0 = at->p0, cap = at->cap;
    for (size_t i = 0; i < n; i++) {
        double q = viscosity_clip(p[i], cap);
        double power = ff_exp(z * ff_log(1 + q / p0));
        double slope = rise * z * power / (p0 + q);
        ln_eta[i] = ln_eta0 + rise * (power - 1) + slope * (p[i] - q);
        dln_dp[i] = slope;
    }
}

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const roelands *r = self;
    isothermal at = {.rise = r->rise, .z = r->exponent, .p0 = r->p0, .cap = r->oil.pressure_cap};
    ff_status status = FF_OK;
    if (r->thermal && (n == 0 || dln_dT || !numerics_is_uniform(n, T)))
        return eval_thermal(r, n, p, T, ln_eta, dln_dp, dln_dT);
    if (r->thermal)
        status = take_isotherm(r, T, &at.rise, &at.z);
    const viscosity_ambient ambient = {.ln_eta0 = r->thermal ? at.rise - 9.67 : r->oil.ln_eta0,
                                       .status = status};
    viscosity_points(curve, &at, ambient.ln_eta0, n, p, ln_eta, dln_dp);
    return viscosity_oil_end(&r->oil, &ambient, n, p, T, ln_eta, dln_dT);
}

static const ff_param params[] = {
    VISCOSITY_OIL_ROWS(roelands),
    FF_QUANTITY("z", "1", roelands, z, 0, NULL, "slope", 0, 2, 0.2, 1.2, "pressure exponent"),
    FF_QUANTITY("alpha", "1/GPa", roelands, own.alpha, 0, NULL, "slope", 0, 1000, 2, 50,
                "slope alpha of ln(eta) at ambient pressure; gives z = alpha p0/(ln eta0 + 9.67); "
                "if neither alpha nor z is given, the pressure coefficient of the oil is used"),
    FF_QUANTITY("p0", "MPa", roelands, p0, 0, "196 MPa", NULL, 10, 1e4, 190, 200,
                "pressure constant of the law"),
    FF_QUANTITY_UNLESS("oil", "s0", "1", roelands, s0, 0, "0", NULL, 0, 10, 0, 2,
                       "temperature exponent for a contact without an oil: ln(eta0) + 9.67 "
                       "decreases as [(T - 138)/(at - 138)]^-s0, T in K; 0: no decrease"),
    VISCOSITY_ALPHA_SLOPE_ROW(roelands, own.slope),
    VISCOSITY_AT_ROW(roelands, own.at),
};

static ff_status ready(void *self)
{
    roelands *r = self;
    viscosity_oil_ready(&r->oil, viscosity_highest_cap);
    if (isnan(r->z) && isnan(r->own.alpha)) {
        ff_status status = viscosity_alpha_ready(r->host, &r->oil, " or z");
        if (status != FF_OK)
            return status;
    }
    bool falls = r->s0 > 0, moves = r->own.slope < 0 || r->own.slope > 0;
    ff_status status = viscosity_at_ready(r->host, &r->own.at, falls ? r->s0 : r->own.slope,
                                          falls ? "s0" : "alpha_slope");
    r->s0 = falls ? r->s0 : 0;
    r->thermal = r->oil.liquid || falls || moves;
    if (r->oil.liquid || status != FF_OK)
        return status;
    r->rise = r->oil.ln_eta0 + 9.67;
    if (r->rise <= 0)
        return ff_failf(r->host, FF_INVALID, "eta0",
                        "the Roelands law needs eta0 above exp(-9.67) = 6.3e-5 Pa s, but eta0 is "
                        "%g Pa s",
                        exp(r->oil.ln_eta0));
    r->exponent = isnan(r->z) ? r->own.alpha * r->p0 / r->rise : r->z;
    if (r->exponent > 2)
        return ff_failf(r->host, FF_INVALID, "alpha",
                        "this alpha gives an exponent z of %g; z must not exceed 2", r->exponent);
    return FF_OK;
}

FF_VISCOSITY_LAW(
    viscosity_roelands, roelands, eval, .id = "viscosity/roelands", .version = "1.0.0",
    .summary = "viscosity rise that flattens with pressure; all isotherms share one pole",
    .reference = "Roelands 1966, thesis, Technische Hogeschool Delft", .bibtex = BIB_Roelands1966,
    .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .inputs = FF_TABLE(viscosity_inputs),
    .wire = viscosity_wire, .ready = ready, .cost = 1.1e-2);
