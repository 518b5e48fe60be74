/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two slopes: ln(eta/eta0) has the slope alpha_1 below the transition and alpha_2 above it (Allen,
   Townsend & Zaretsky 1970). Over `transition_width` the slope changes linearly from alpha_1 to
   alpha_2 (Goglia, Cusano & Conry 1984). */
#include "law.h"
#include "references.h"

#include "../numerics/liquid.h"

#include <math.h>

typedef struct two_slope {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
    double alpha_1, alpha_2, middle, width; /* 1/Pa, Pa */
    double alpha_slope, at;                 /* 1/K, K */
} two_slope;

FF_SIMD
static void curve(const void *self, double ln_eta0, size_t n, const double *restrict p,
                  double *restrict ln_eta, double *restrict dln_dp)
{
    const two_slope *t = self;
    const double first = t->alpha_1, change = t->alpha_2 - first, width = t->width;
    const double begin = t->middle - width / 2, end = t->middle + width / 2;
    const double part = width > 0 ? 1 / width : 0, cap = t->oil.pressure_cap;
    for (size_t i = 0; i < n; i++) {
        double q = viscosity_clip(p[i], cap);
        double over = q > end ? q - end : 0, in = q > begin ? q - begin : 0;
        double inside = in < width ? in : width, share = inside * part;
        /* for a transition of width 0, the upper slope holds at the transition itself */
        double slope = first + change * (q >= end ? 1 : share);
        ln_eta[i] =
            ln_eta0 + first * q + change * (over + inside * inside * part / 2) + slope * (p[i] - q);
        dln_dp[i] = slope;
    }
}

static int64_t rise(const void *self, size_t n, const double *p, const double *T, double *rise,
                    double *by_p, double *by_T)
{
    const two_slope *t = self;
    int64_t outside = 0;
    curve(t, 0, n, p, rise, by_p);
    for (size_t i = 0; i < n; i++) {
        double in = viscosity_temperature(T[i]), factor = exp(t->alpha_slope * (in - t->at));
        int beyond = in < T[i] || in > T[i];
        rise[i] *= factor;
        by_p[i] *= factor;
        by_T[i] = beyond ? 0 : t->alpha_slope * rise[i];
        outside |= beyond || p[i] > t->oil.pressure_cap;
    }
    return outside;
}

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const two_slope *t = self;
    two_slope hot = *t;
    if (!(t->alpha_slope < 0 || t->alpha_slope > 0) || n == 0)
        return viscosity_eval(self, curve, n, p, T, ln_eta, dln_dp, dln_dT);
    if (dln_dT || !numerics_is_uniform(n, T))
        return viscosity_eval_rise(self, rise, t->at, n, p, T, ln_eta, dln_dp, dln_dT);
    double in = viscosity_temperature(viscosity_one_temperature(self, t->at, T));
    hot.alpha_1 *= exp(t->alpha_slope * (in - t->at));
    hot.alpha_2 *= exp(t->alpha_slope * (in - t->at));
    return viscosity_eval((const viscosity_law *)&hot, curve, n, p, T, ln_eta, dln_dp, NULL);
}

static const ff_param params[] = {
    VISCOSITY_OIL_ROWS(two_slope),
    FF_QUANTITY("alpha_1", "1/GPa", two_slope, alpha_1, FF_REQUIRED, NULL, NULL, 0, 1000, 2, 50,
                "pressure-viscosity coefficient below the transition"),
    FF_QUANTITY("alpha_2", "1/GPa", two_slope, alpha_2, FF_REQUIRED, NULL, NULL, 0, 1000, 1, 50,
                "pressure-viscosity coefficient above the transition"),
    FF_QUANTITY("p_transition", "GPa", two_slope, middle, FF_REQUIRED | FF_MIN_OPEN, NULL, NULL, 0,
                100, 0.05, 1, "pressure at which the two lines of ln(eta) meet"),
    FF_QUANTITY(
        "transition_width", "GPa", two_slope, width, 0, "0 GPa", NULL, 0, 100, 0, 0,
        "pressure range around p_transition over which the slope changes; 0: the slope jumps"),
    VISCOSITY_ALPHA_SLOPE_ROW(two_slope, alpha_slope),
    VISCOSITY_AT_ROW(two_slope, at),
};

static ff_status ready(void *self)
{
    two_slope *t = self;
    if (t->width > 2 * t->middle)
        return ff_failf(t->host, FF_INVALID, "transition_width",
                        "the transition would begin below ambient pressure: its width, %g GPa, "
                        "must not exceed twice p_transition, %g GPa",
                        1e-9 * t->width, 1e-9 * t->middle);
    viscosity_oil_ready(&t->oil, viscosity_highest_cap);
    return viscosity_at_ready(t->host, &t->at, t->alpha_slope, "alpha_slope");
}

FF_VISCOSITY_LAW(viscosity_two_slope, two_slope, eval, .id = "viscosity/two-slope",
                 .version = "1.0.0", .summary = "Barus' law with another slope at high pressure",
                 .reference = "Allen, Townsend & Zaretsky 1970, J. Lubrication Technology 92, "
                              "145-155; Goglia, Cusano & Conry 1984, J. Tribology 106, 104-112",
                 .bibtex = BIB_Allen1970 "\n" BIB_Goglia1984, .licence = "GPL-3.0-or-later",
                 .params = FF_TABLE(params), .inputs = FF_TABLE(viscosity_inputs),
                 .wire = viscosity_wire, .ready = ready, .cost = 2.4e-3);
