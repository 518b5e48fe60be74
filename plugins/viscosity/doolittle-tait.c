/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Doolittle free volume with the Tait equation of state (Li & Kahraman 2011, eqs 11a, 11b):
 *   V = 1 - ln(1 + p (1 + K0')/K0) / (1 + K0')
 *   ln(eta/eta0) = B V_occ (1 - V) / [(V - V_occ) (1 - V_occ)]
 * There is a pole where V decreases to the occupied volume V_occ; the pressure cap stays below
 * it. With temperature (Bair 2007), relative to `at`: K0 changes by exp(-K0_decay (T - at)),
 * V_occ by exp(V_occ_slope (T - at)). V_occ is relative to the volume at ambient pressure, which
 * itself grows with T. */
#include "law.h"
#include "references.h"

#include "../numerics/liquid.h"

#include <math.h>
#include <stdbool.h>

typedef struct doolittle_tait {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
    double B, V_occ, K0, K0_prime;
    double K0_decay, V_occ_slope, at; /* 1/K, 1/K, K */
    bool thermal;                     /* one of the slopes is not 0 */
    double most, share; /* cap of p/K0: `most`, or `share` of the pole if that is smaller */
} doolittle_tait;

/* Upper bound of V_occ, relative to the total volume. */
static const double MOST_OCCUPIED = 0.98;

FF_SIMD
static void curve(const void *self, double ln_eta0, size_t n, const double *restrict p,
                  double *restrict ln_eta, double *restrict dln_dp)
{
    const doolittle_tait *d = self;
    const double B = d->B, V_occ = d->V_occ, K0 = d->K0, k = 1 + d->K0_prime;
    const double cap = d->oil.pressure_cap;
    for (size_t i = 0; i < n; i++) {
        double q = viscosity_clip(p[i], cap);
        double shrinkage = ff_log(1 + q * k / K0) / k; /* 1 - V */
        double free = 1 - shrinkage - V_occ;           /* V - V_occ */
        double scale = B * V_occ / free;
        double slope = scale / free / (K0 + q * k);
        ln_eta[i] = ln_eta0 + scale * shrinkage / (1 - V_occ) + slope * (p[i] - q);
        dln_dp[i] = slope;
    }
}

/* With x = p/K0(T), R = V_occ(T), w = 1 - V, f = V - R, w' = dw/dx = 1/(1 + k x), the rise and its
   slopes are
     r = B R w/[f (1 - R)],   r_x = B R w'/f^2,   r_xx = B R w' [2 w'/f - k w']/f^2,
     r_R = B w [1 + R/f + R/(1 - R)]/[f (1 - R)],   r_xR = B w' [1 + 2 R/f]/f^2.
   Above the cap c, r continues along its tangent in x. If c is a share of the pole, it depends on
   R. */
FF_SIMD
static int64_t rise(const void *self, size_t n, const double *restrict p, const double *restrict T,
                    double *restrict rise, double *restrict by_p, double *restrict by_T)
{
    const doolittle_tait *d = self;
    const double B = d->B, V_occ = d->V_occ, K0 = d->K0, k = 1 + d->K0_prime, at = d->at;
    const double decay = d->K0_decay, change = d->V_occ_slope, most = d->most, share = d->share;
    const double full = MOST_OCCUPIED;
    int64_t outside = 0;
    for (size_t i = 0; i < n; i++) {
        double in = viscosity_temperature(T[i]), off = T[i] - in, inside = off * off > 0 ? 0 : 1;
        double soft = ff_exp(decay * (in - at)) / K0, x = p[i] * soft;
        double R = V_occ * ff_exp(change * (in - at)), R_T = R < full ? change * R : 0;
        R = R < full ? R : full;
        double power = share * ff_exp((1 - R) * k), pole = (power - share) / k;
        double c = pole < most ? pole : most, c_R = pole < most ? -power : 0;
        double q = viscosity_clip(x, c), beyond = x - q, w = ff_log(1 + q * k) / k,
               free = 1 - w - R;
        double w_x = 1 / (1 + q * k), g = 1 / free, rest = 1 / (1 - R);
        double slope = B * R * w_x * g * g;
        double r_R = B * w * g * rest * (1 + R * g + R * rest);
        double bend = slope * w_x * (2 * g - k), r_xR = B * w_x * g * g * (1 + 2 * R * g);
        c_R = x > c ? c_R : 0;
        double value = B * R * w * g * rest + slope * beyond;
        rise[i] = value;
        by_p[i] = slope * soft;
        by_T[i] = inside * (decay * x * slope + (r_R + (r_xR + bend * c_R) * beyond) * R_T);
        outside |= (x > c) | (off * off > 0);
    }
    return outside;
}

/* Returns the law at one temperature. */
static doolittle_tait isotherm_of(const doolittle_tait *d, double T)
{
    doolittle_tait hot = *d;
    double in = viscosity_temperature(T), k = 1 + d->K0_prime;
    hot.K0 = d->K0 * exp(-d->K0_decay * (in - d->at));
    hot.V_occ = fmin(d->V_occ * exp(d->V_occ_slope * (in - d->at)), MOST_OCCUPIED);
    hot.oil.pressure_cap = hot.K0 * fmin(d->most, d->share * expm1((1 - hot.V_occ) * k) / k);
    return hot;
}

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const doolittle_tait *d = self;
    if (!d->thermal || n == 0)
        return viscosity_eval(self, curve, n, p, T, ln_eta, dln_dp, dln_dT);
    if (dln_dT || !numerics_is_uniform(n, T))
        return viscosity_eval_rise(self, rise, d->at, n, p, T, ln_eta, dln_dp, dln_dT);
    doolittle_tait hot = isotherm_of(d, viscosity_one_temperature(self, d->at, T));
    return viscosity_eval((const viscosity_law *)&hot, curve, n, p, T, ln_eta, dln_dp, NULL);
}

static const ff_param params[] = {
    VISCOSITY_OIL_ROWS(doolittle_tait),
    FF_QUANTITY("B", "1", doolittle_tait, B, FF_REQUIRED, NULL, NULL, 0, 100, 1, 10,
                "Doolittle's constant"),
    FF_QUANTITY("V_occ", "1", doolittle_tait, V_occ, FF_REQUIRED, NULL, NULL, 0.05, 0.95, 0.5, 0.8,
                "occupied volume over the volume at ambient pressure"),
    FF_QUANTITY("K0", "GPa", doolittle_tait, K0, FF_REQUIRED, NULL, NULL, 0.01, 1000, 0.5, 3,
                "bulk modulus at ambient pressure"),
    FF_QUANTITY("K0_prime", "1", doolittle_tait, K0_prime, FF_REQUIRED, NULL, NULL, 0, 100, 8, 13,
                "derivative K0' of the bulk modulus over pressure"),
    FF_QUANTITY("K0_decay", "1/K", doolittle_tait, K0_decay, 0, "0 1/K", NULL, -0.02, 0.05, 0,
                0.009, "decrease of ln(K0) per kelvin above the temperature `at`"),
    FF_QUANTITY("V_occ_slope", "1/K", doolittle_tait, V_occ_slope, 0, "0 1/K", NULL, -0.02, 0.02,
                -0.004, 0, "change of ln(V_occ) per kelvin above the temperature `at`"),
    VISCOSITY_AT_ROW(doolittle_tait, at),
};

static ff_status ready(void *self)
{
    doolittle_tait *d = self;
    double k = 1 + d->K0_prime;
    double pole = d->K0 * expm1((1 - d->V_occ) * k) / k; /* pressure at which V = V_occ, Pa */
    bool given = !isnan(d->oil.pressure_cap), decays = d->K0_decay < 0 || d->K0_decay > 0;
    d->most = (given ? d->oil.pressure_cap : viscosity_highest_cap) / d->K0;
    d->share = given ? fmax(0.5, d->oil.pressure_cap / pole) : 0.5;
    d->thermal = decays || d->V_occ_slope < 0 || d->V_occ_slope > 0;
    viscosity_oil_ready(&d->oil, fmin(viscosity_highest_cap, pole / 2));
    if (d->oil.pressure_cap > 0.9 * pole)
        return ff_failf(d->host, FF_INVALID, "pressure_cap",
                        "the free volume is 0 at %g GPa; pressure_cap must be below 0.9 of this "
                        "pressure",
                        1e-9 * pole);
    return viscosity_at_ready(d->host, &d->at, decays ? d->K0_decay : d->V_occ_slope,
                              decays ? "K0_decay" : "V_occ_slope");
}

FF_VISCOSITY_LAW(viscosity_doolittle_tait, doolittle_tait, eval, .id = "viscosity/doolittle-tait",
                 .version = "1.0.0",
                 .summary = "free-volume law: ln(eta) rises steeply at ambient pressure, then "
                            "less, then steeply again",
                 .reference = "Doolittle 1951, J. Appl. Phys. 22, 1471-1475; Li & Kahraman 2011, "
                              "Proc. IMechE J, 740-753; with temperature: Bair 2007, High-Pressure "
                              "Rheology for Quantitative Elastohydrodynamics",
                 .bibtex = BIB_Doolittle1951 "\n" BIB_LiKahraman2011 "\n" BIB_Bair2007,
                 .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
                 .inputs = FF_TABLE(viscosity_inputs), .wire = viscosity_wire, .ready = ready,
                 .cost = 8e-3);
