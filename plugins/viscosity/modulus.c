/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bode's law: ln(eta/eta0) = p/(A + B p), A = a1 + a2 T, B = b1 + b2 T (T in K), fitted to gear
   oils by Gold et al. 2001. For each base, A and B were measured on one ISO VG 100 oil. For
   another oil of that base, A is multiplied by the ratio of the pressure coefficients, VG 100 oil
   over this oil, so that the slope at ambient pressure is right. */
#include "law.h"
#include "references.h"

#include "../numerics/liquid.h"

#include <math.h>
#include <stdbool.h>

enum { PARAFFINIC, NAPHTHENIC, PAO, BASES };

/* Arana, Larranaga & Ulacia 2019, tables 2 and 3: measured up to 0.5 to 1 GPa, 25 to 100 degC. */
static const double measured_to = 1e9, coldest_measured = 298.15, hottest_measured = 373.15;
static const struct modulus_constants {
    double a1, a2, b1, b2; /* Pa, Pa/K, 1, 1/K */
} of_base[BASES] = {
    [PARAFFINIC] = {-2.28e7, 2.26e5, -0.0682, 2.768e-4},
    [NAPHTHENIC] = {-7.23e7, 3.48e5, 5.0e-3, -1.83e-5},
    [PAO] = {-5.73e7, 3.90e5, -0.0395, 2.354e-4},
};

/* The ratio of A to the A of the VG 100 oil is stored at this many equal steps of temperature; a
   cubic interpolates between them. */
enum { NODES = 111 };

typedef struct modulus {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
    double a1, a2, b1, b2; /* SI; a1 NaN: the constants of the base oil are used */
    double factor;         /* factor on ln(eta/eta0) */
    int32_t base;          /* -1: base of the wired oil */
    double least, most;    /* K, the range of the law */
    bool measured;         /* whether the constants were measured on a base oil */
    bool scaled;
    double scale[NODES], slope[NODES]; /* 1, 1/K */
} modulus;

/* A and B at a temperature, and their slopes. */
typedef struct moduli {
    double A, B, A_T, B_T;
} moduli;

static double scale_at(const modulus *m, double T, double *slope)
{
    const double step = (viscosity_hottest - viscosity_coldest) / (NODES - 1);
    *slope = 0;
    if (!m->scaled)
        return 1;
    double at = (T - viscosity_coldest) / step;
    size_t i = at < NODES - 2 ? (size_t)at : NODES - 2;
    double t = at - (double)i, u = 1 - t, left = m->scale[i], right = m->scale[i + 1];
    double by_left = step * m->slope[i], by_right = step * m->slope[i + 1];
    *slope = (6 * t * u * (right - left) + u * (1 - 3 * t) * by_left - t * (2 - 3 * t) * by_right) /
             step;
    return u * u * (1 + 2 * t) * left + t * t * (3 - 2 * t) * right +
           t * u * (u * by_left - t * by_right);
}

static double within(const modulus *m, double T)
{
    return fmin(fmax(T, m->least), m->most);
}

static moduli moduli_at(const modulus *m, double T)
{
    double slope, scale = scale_at(m, T, &slope), A = m->a1 + m->a2 * T;
    const double over = 1 / m->factor, B = m->b1 + m->b2 * T;
    return (moduli){over * A * scale, over * B, over * (m->a2 * scale + A * slope), over * m->b2};
}

/* The law at a single temperature. */
typedef struct isotherm {
    double A, B, cap;
} isotherm;

FF_SIMD
static void curve(const void *law, double ln_eta0, size_t n, const double *restrict p,
                  double *restrict ln_eta, double *restrict dln_dp)
{
    const isotherm *at = law;
    const double A = at->A, B = at->B, cap = at->cap;
    for (size_t i = 0; i < n; i++) {
        double q = viscosity_clip(p[i], cap), part = 1 / (A + B * q), slope = A * part * part;
        ln_eta[i] = ln_eta0 + q * part + slope * (p[i] - q);
        dln_dp[i] = slope;
    }
}

/* Returns 1 if measured constants are extrapolated beyond the measurements. */
static int extrapolates(const modulus *m, double p, double T)
{
    const double rounding = 1e-9;
    return m->measured && (p > measured_to * (1 + rounding) || T < coldest_measured - rounding ||
                           T > hottest_measured + rounding);
}

static int64_t rise(const void *self, size_t n, const double *p, const double *T, double *rise,
                    double *by_p, double *by_T)
{
    const modulus *m = self;
    int64_t outside = 0;
    for (size_t i = 0; i < n; i++) {
        double in = within(m, T[i]), q = viscosity_clip(p[i], m->oil.pressure_cap);
        const moduli at = moduli_at(m, in);
        double part = 1 / (at.A + at.B * q), slope = at.A * part * part;
        double part_T = -(at.A_T + at.B_T * q) * part * part;
        int beyond = in < T[i] || in > T[i];
        rise[i] = q * part + slope * (p[i] - q);
        by_p[i] = slope;
        by_T[i] = q * part_T + (at.A_T * part * part + 2 * at.A * part * part_T) * (p[i] - q);
        by_T[i] = beyond ? 0 : by_T[i];
        outside |= beyond || p[i] > m->oil.pressure_cap || extrapolates(m, p[i], T[i]);
    }
    return outside;
}

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const modulus *m = self;
    if (dln_dT || !numerics_is_uniform(n, T))
        return viscosity_eval_rise(self, rise, 313.15, n, p, T, ln_eta, dln_dp, dln_dT);
    if (n == 0)
        return FF_OK;
    const viscosity_ambient ambient = viscosity_oil_begin(&m->oil, n, T);
    const double all = viscosity_one_temperature(self, 313.15, T), in = within(m, all);
    const moduli at = moduli_at(m, in);
    const isotherm one = {at.A, at.B, m->oil.pressure_cap};
    viscosity_points(curve, &one, ambient.ln_eta0, n, p, ln_eta, dln_dp);
    ff_status status = viscosity_oil_end(&m->oil, &ambient, n, p, T, ln_eta, NULL);
    int outside = in < all || in > all;
    for (size_t i = 0; i < n && !outside; i++)
        outside = extrapolates(m, p[i], all);
    return outside ? numerics_worse(status, FF_DOMAIN) : status;
}

static const ff_param params[] = {
    VISCOSITY_OIL_ROWS(modulus),
    FF_ONE_OF(
        "paraffinic|naphthenic|PAO", "base", modulus, base, 0, NULL,
        "measured ISO VG 100 oil, whose A and B are used unchanged; left out: the measured oil "
        "with the base of the wired oil (mineral: paraffinic), with A scaled to the pressure "
        "coefficient of the wired oil"),
    FF_QUANTITY(
        "a1", "Pa", modulus, a1, 0, NULL, NULL, -1e12, 1e12, -2e8, 2e8,
        "A at 0 K, instead of the A of the base oil; with a2 = 0 it is A at every temperature"),
    FF_QUANTITY("a2", "Pa/K", modulus, a2, 0, "0 Pa/K", NULL, -1e10, 1e10, 0, 1e6,
                "slope of A over temperature"),
    FF_QUANTITY("b1", "1", modulus, b1, 0, NULL, NULL, -100, 100, -0.2, 0.2,
                "B at 0 K; if only a1 is given, B is 0 and the law is that of Barus"),
    FF_QUANTITY("b2", "1/K", modulus, b2, 0, "0 1/K", NULL, -1, 1, -1e-3, 1e-3,
                "slope of B over temperature"),
    FF_QUANTITY("pressure_factor", "1", modulus, factor, FF_MIN_OPEN, "1", NULL, 0, 10, 0.8, 1.25,
                "factor on ln(eta/eta0), and thus on the pressure coefficient; its uncertainty is "
                "1 +- 0.1"),
};

/* Sets the constants to those of the base oil, which the law or the wired oil names. */
static ff_status take_base(modulus *m)
{
    static const int of_oil[] = {[FF_BASE_MINERAL] = PARAFFINIC, [FF_BASE_PAO] = PAO};
    double T = m->oil.liquid ? numerics_reference_temperature(m->oil.liquid) : 0, base = NAN;
    if (m->oil.liquid &&
        m->oil.liquid->eval(m->oil.liquid->self, FF_LIQUID_BASE, 1, &T, &base, NULL) < 0)
        base = NAN;
    bool known = base >= 0 && base <= FF_BASE_PAO, typed = m->base >= 0;
    if (m->base < 0 && !known)
        return ff_failf(m->host, FF_INVALID, "base",
                        "A and B are known for mineral oils and PAO only, and %s: give a1, a2, b1 "
                        "and b2, or base, or use another law",
                        isnan(base) ? "the base of the oil is unknown"
                                    : "this oil has another "
                                      "base");
    if (m->base < 0)
        m->base = of_oil[(int)base];
    else if (known && (m->base == PAO) != (of_oil[(int)base] == PAO))
        return ff_failf(m->host, FF_INVALID, "base",
                        "the base oil is given twice: %s here, and %s in the oil stage",
                        m->base == PAO ? "PAO" : "mineral", m->base == PAO ? "mineral" : "PAO");
    m->a1 = of_base[m->base].a1;
    m->a2 = of_base[m->base].a2;
    m->b1 = of_base[m->base].b1;
    m->b2 = of_base[m->base].b2;
    m->scaled = known && !typed;
    m->measured = true;
    return FF_OK;
}

/* Returns the pressure coefficient of the VG 100 oil over that of the wired oil, and the slope of
   this ratio over T. The ratio is 1 for an oil without a pressure coefficient. */
static double ratio_at(const ff_liquid *liquid, double T, double *slope)
{
    double own = NAN, by_own = NAN, base = NAN, by_base = NAN;
    liquid->eval(liquid->self, FF_LIQUID_PRESSURE_COEFFICIENT, 1, &T, &own, &by_own);
    liquid->eval(liquid->self, FF_LIQUID_BASE_COEFFICIENT, 1, &T, &base, &by_base);
    double ratio = base / own, by_T = ratio * (by_base / base - by_own / own);
    *slope = isfinite(by_T) ? by_T : 0;
    return ratio > 0 && isfinite(ratio) ? ratio : NAN;
}

/* Sets the scale of A. If the pressure coefficient of the oil is known at one temperature only, the
   scale is constant. */
static void take_scale(modulus *m)
{
    const ff_liquid *liquid = m->oil.liquid;
    double unused, same = ratio_at(liquid, numerics_reference_temperature(liquid), &unused);
    bool moves = false;
    same = isnan(same) ? 1 : same;
    for (size_t i = 0; i < NODES; i++) {
        double T =
            viscosity_coldest + (viscosity_hottest - viscosity_coldest) * (double)i / (NODES - 1);
        m->scale[i] = ratio_at(liquid, T, &m->slope[i]);
        if (isnan(m->scale[i])) {
            m->scale[i] = same;
            m->slope[i] = 0;
        }
        moves = moves || fabs(m->scale[i] - 1) > 1e-12;
    }
    m->scaled = moves;
}

/* Returns whether A and A + B p, for p up to the cap, are at least `least`. */
static bool holds_at(const modulus *m, double T, double least)
{
    const moduli at = moduli_at(m, T);
    return at.A >= least && at.A + at.B * m->oil.pressure_cap >= least;
}

/* Searches from T, where the law holds, towards `last`. Returns the temperature up to which it
   holds. */
static double end_of_range(const modulus *m, double T, double last, double least)
{
    enum { STEPS = 500, HALVINGS = 40 };
    for (int i = 1; i <= STEPS; i++) {
        double good = T + (last - T) * (i - 1) / STEPS, bad = T + (last - T) * i / STEPS;
        if (holds_at(m, bad, least))
            continue;
        for (int k = 0; k < HALVINGS; k++) {
            double middle = (good + bad) / 2;
            if (holds_at(m, middle, least))
                good = middle;
            else
                bad = middle;
        }
        return good;
    }
    return last;
}

static ff_status ready(void *self)
{
    modulus *m = self;
    viscosity_oil_ready(&m->oil, viscosity_highest_cap);
    const bool alone = m->a2 < 0 || m->a2 > 0 || m->b2 < 0 || m->b2 > 0 || !isnan(m->b1);
    ff_status status = FF_OK;
    m->scaled = m->measured = false;
    if (!isnan(m->a1) && m->base >= 0)
        return ff_failf(m->host, FF_INVALID, "base",
                        "a1 and base both determine A: leave one of them out");
    if (isnan(m->a1) && alone)
        return ff_failf(m->host, FF_INVALID, "a1", "a2, b1 and b2 need a1");
    if (isnan(m->a1)) {
        status = take_base(m);
    } else {
        m->b1 = isnan(m->b1) ? 0 : m->b1;
    }
    if (status != FF_OK)
        return status;
    if (m->scaled)
        take_scale(m);
    const double cap = m->oil.pressure_cap, T = viscosity_one_temperature(self, 313.15, NULL);
    const moduli at = moduli_at(m, T);
    const double least = 0.05 * fabs(at.A);
    if (!(at.A > 0) || !holds_at(m, T, least))
        return ff_failf(m->host, FF_INVALID, "a1",
                        "at %g degC A is %.4g MPa and B is %.4g; A and A + B p must be above 0 for "
                        "p up to %g GPa",
                        T - 273.15, 1e-6 * at.A, at.B, 1e-9 * cap);
    m->least = end_of_range(m, T, viscosity_coldest, least);
    m->most = end_of_range(m, T, viscosity_hottest, least);
    return FF_OK;
}

FF_VISCOSITY_LAW(
    viscosity_modulus, modulus, eval, .id = "viscosity/modulus", .version = "1.0.0",
    .summary = "measured viscosity rise of gear oils up to 1 GPa, depending on the base oil",
    .reference = "Gold, Schmidt, Dicke, Loos & Assmann 2001, J. Synth. Lubr. 18, "
                 "51-79; Arana, Larranaga & Ulacia 2019, tables 2 and 3, after Mann 1995 "
                 "and Hoglund 1999",
    .bibtex = BIB_Gold2001 "\n" BIB_Arana2019, .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params), .inputs = FF_TABLE(viscosity_inputs), .wire = viscosity_wire,
    .ready = ready, .cost = 1e-3);
