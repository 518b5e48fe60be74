/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Yasutomi's free volume (Yasutomi, Bair & Winer 1984), with pressure in GPa:
 *   Tg = Tg0 + A1 ln(1 + A2 p),   F = 1 - B1 ln(1 + B2 p),   X = (T - Tg) F,
 *   ln(eta/eta_g) = Y = -C1 ln(10) X/(C2 + X).
 * The oil gives the viscosity at ambient pressure, so ln(eta/eta0) = Y(p, T) - Y(0, T), and
 * eta_g is not needed. Below Tg, where X < 0, the liquid is a glass: ln(eta) continues linearly
 * from there. */
#include "law.h"
#include "references.h"

#include "../numerics/liquid.h"

#include <math.h>

typedef struct yasutomi {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
    double Tg0, A1, A2, B1, B2, C1, C2, at; /* K, K, 1/Pa, 1, 1/Pa, 1, K, K */
    double end;                             /* pressure at which F = 0, Pa */
} yasutomi;

/* The law is evaluated at least this far above Tg0, K. */
static const double ABOVE_GLASS = 1;

/* Slopes: with D = C1 ln(10) C2,
 *   Y_X = -D/(C2 + X)^2, Y_XX = 2 D/(C2 + X)^3,
 *   r_p = Y_X X_p,  r_T = Y_X(X) F - Y_X(X0),  r_pT = Y_XX F X_p + Y_X F_p,
 *   r_pp = Y_XX X_p^2 + Y_X X_pp,   X0 = T - Tg0.
 * The pressure q at the glass transition, X = 0, moves with T, since Tg(q) = T. The tangent from
 * there has the slope r_T + (r_pT + r_pp q_T) (p - q) over T. */
FF_SIMD
static int64_t rise(const void *self, size_t n, const double *restrict p, const double *restrict T,
                    double *restrict rise, double *restrict by_p, double *restrict by_T)
{
    const yasutomi *y = self;
    const double Tg0 = y->Tg0, A1 = y->A1, A2 = y->A2, B1 = y->B1, B2 = y->B2, C2 = y->C2;
    const double N = y->C1 * 2.302585092994046, D = N * C2, above = ABOVE_GLASS;
    const double cap = y->oil.pressure_cap < y->end ? y->oil.pressure_cap : y->end;
    int64_t outside = 0;
    for (size_t i = 0; i < n; i++) {
        double in = viscosity_temperature(T[i]);
        in = in > Tg0 + above ? in : Tg0 + above;
        double off = T[i] - in, inside = off * off > 0 ? 0 : 1, X0 = in - Tg0;
        double power = ff_exp(X0 / A1), glass = (power - 1) / A2;
        double q_T = glass < cap ? power / (A1 * A2) : 0, last = glass < cap ? glass : cap;
        double q = viscosity_clip(p[i], last), beyond = p[i] - q;
        q_T = p[i] > last ? q_T : 0;
        double a = 1 / (1 + A2 * q), b = 1 / (1 + B2 * q);
        double t = X0 - A1 * ff_log(1 + A2 * q), F = 1 - B1 * ff_log(1 + B2 * q);
        double Tg_p = A1 * A2 * a, F_p = -B1 * B2 * b, X = t * F, X_p = t * F_p - Tg_p * F;
        double X_pp = Tg_p * A2 * a * F - 2 * Tg_p * F_p - t * F_p * B2 * b;
        double g = 1 / (C2 + X), g0 = 1 / (C2 + X0), Y_X = -D * g * g, Y_XX = 2 * D * g * g * g;
        double slope = Y_X * X_p, bend = Y_XX * X_p * X_p + Y_X * X_pp;
        double by_both = Y_XX * F * X_p + Y_X * F_p;
        rise[i] = N * (X0 * g0 - X * g) + slope * beyond;
        by_p[i] = slope;
        by_T[i] = inside * (Y_X * F + D * g0 * g0 + (by_both + bend * q_T) * beyond);
        outside |= (p[i] > last) | (off * off > 0);
    }
    return outside;
}

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const yasutomi *y = self;
    return viscosity_eval_rise(self, rise, y->at, n, p, T, ln_eta, dln_dp, dln_dT);
}

static const ff_param params[] = {
    VISCOSITY_OIL_ROWS(yasutomi),
    FF_QUANTITY("Tg0", "degC", yasutomi, Tg0, FF_REQUIRED, NULL, NULL, -200, 100, -120, 0,
                "glass transition temperature Tg0 at ambient pressure"),
    FF_QUANTITY("A1", "K", yasutomi, A1, FF_REQUIRED, NULL, NULL, 1, 5000, 20, 500,
                "A1 in the glass transition temperature Tg = Tg0 + A1 ln(1 + A2 p)"),
    FF_QUANTITY("A2", "1/GPa", yasutomi, A2, FF_REQUIRED, NULL, NULL, 0.01, 100, 0.2, 5,
                "A2 in the glass transition temperature Tg = Tg0 + A1 ln(1 + A2 p)"),
    FF_QUANTITY("B1", "1", yasutomi, B1, FF_REQUIRED, NULL, NULL, 0, 100, 0.1, 10,
                "B1 in the relative expansivity of the free volume F = 1 - B1 ln(1 + B2 p)"),
    FF_QUANTITY("B2", "1/GPa", yasutomi, B2, FF_REQUIRED, NULL, NULL, 0, 1000, 0.05, 50,
                "B2 in the relative expansivity of the free volume F = 1 - B1 ln(1 + B2 p)"),
    FF_QUANTITY("C1", "1", yasutomi, C1, FF_REQUIRED, NULL, NULL, 1, 100, 8, 20,
                "C1: lg(eta_g/eta) far above the glass transition, with the viscosity eta_g at the "
                "transition"),
    FF_QUANTITY("C2", "K", yasutomi, C2, FF_REQUIRED, NULL, NULL, 1, 500, 10, 60,
                "C2 in lg(eta_g/eta) = C1 (T - Tg) F/[C2 + (T - Tg) F]"),
    FF_QUANTITY_OR("auto", "at", "degC", yasutomi, at, 0, "auto", NULL, -150, 500, -20, 150,
                   "temperature of eta0, for a contact without an oil; auto: 40 degC"),
};

static ff_status ready(void *self)
{
    yasutomi *y = self;
    y->at = isnan(y->at) ? 313.15 : y->at;
    /* slightly below the pressure at which F = 0, so that the slope at the end is that of the
       liquid */
    y->end = y->B1 * y->B2 > 0 ? (exp(fmin(1 / y->B1, 60)) - 1) / y->B2 : 1e12;
    viscosity_oil_ready(&y->oil, viscosity_highest_cap);
    return FF_OK;
}

FF_VISCOSITY_LAW(viscosity_yasutomi, yasutomi, eval, .id = "viscosity/yasutomi", .version = "1.0.0",
                 .summary = "free volume above the glass transition, over pressure and temperature",
                 .reference = "Yasutomi, Bair & Winer 1984, J. Tribology 106, 291-302",
                 .bibtex = BIB_Yasutomi1984, .licence = "GPL-3.0-or-later",
                 .params = FF_TABLE(params), .inputs = FF_TABLE(viscosity_inputs),
                 .wire = viscosity_wire, .ready = ready, .cost = 1.2e-2);
