/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ree-Eyring: the mean shear stress is tau_m = tau0 asinh(S), S = eta u_s/(tau0 h). The fluidity
   for the pressure flow is increased by cosh(tau_m/tau0) (Li & Kahraman 2011, eq. 8a), so psi =
   cosh(asinh S)/eta = sqrt(1/eta^2 + (u_s/(tau0 h))^2). At a point, the rate is (tau0/eta)
   sinh(tau/tau0); its slope at tau_m is psi. */
#include "law.h"
#include "references.h"

#include "../numerics/liquid.h"

static const double STRESS_MAX = 1e300; /* Pa */
static const double SLIP_MAX = 1e100;   /* m/(Pa s), bound of the sliding speed over tau0 */

typedef struct ree_eyring {
    const ff_host *host;
    ff_rheology service;
    ff_rheology_2 service_2;
    ff_rheology_3 service_3;
    rheology_eyring eyring;
    double limiting_stress_coefficient;
    double tau0; /* Pa; NaN: auto */
} ree_eyring;

/* tau0 and its slope over p at n <= RHEOLOGY_BLOCK points. */
static ff_status stresses_at(const void *self, size_t n, const double *p, const double *T,
                             double *tau0, double *by_p)
{
    const ree_eyring *r = self;
    if (isnan(r->tau0))
        return rheology_eyring_stress(&r->eyring, n, p, T, tau0, by_p);
    for (size_t i = 0; i < n; i++) {
        tau0[i] = r->tau0;
        by_p[i] = 0;
    }
    return FF_OK;
}

FF_SIMD
static void take_logs(size_t n, const double *restrict x, double *restrict ln)
{
    for (size_t i = 0; i < n; i++)
        ln[i] = ff_log(x[i]);
}

/* ln(tau0) at the points that stresses_at has evaluated. */
static void logs_of(const ree_eyring *r, size_t n, const double *tau0, double *ln)
{
    if (isnan(r->tau0)) {
        take_logs(n, tau0, ln);
        return;
    }
    const double same = n > 0 ? log(tau0[0]) : 0;
    for (size_t i = 0; i < n; i++)
        ln[i] = same;
}

/* psi for tau0, and its slopes. On entry the array for the slope over p has the slope of tau0; on
   return that of psi. */
FF_SIMD
static int64_t curve(const void *law, double u_s, size_t n, const double *restrict tau0,
                     const double *restrict ln_eta, const double *restrict h, double *restrict psi,
                     double *restrict by_p, double *restrict by_ln_eta, double *restrict by_h)
{
    const double speed = fabs(u_s), least_tau0 = speed / SLIP_MAX;
    int64_t held = 0;
    (void)law;
    for (size_t i = 0; i < n; i++) {
        double film = rheology_film(h[i]), ratio_0 = speed / tau0[i];
        double slip = ratio_0 < SLIP_MAX ? ratio_0 : SLIP_MAX;
        double a = rheology_fluidity(ln_eta[i]), s = slip / film;
        double most = a > s ? a : s, least = a > s ? s : a, ratio = least / most;
        double root = most * sqrt(1 + ratio * ratio);
        double by_eta = -a * (a / root), by_film = -s * (s / root) / film;
        psi[i] = root;
        by_ln_eta[i] = ln_eta[i] > -RHEOLOGY_LN_MAX ? by_eta : 0;
        by_h[i] = h[i] > RHEOLOGY_FILM_MIN ? by_film : 0;
        by_p[i] *= -s * (s / root) / tau0[i];
        held |=
            (ln_eta[i] < -RHEOLOGY_LN_MAX) | (h[i] < RHEOLOGY_FILM_MIN) | (tau0[i] < least_tau0);
    }
    return held;
}

static ff_status flow_at(const void *self, size_t n, const double *p, const double *T,
                         const double *ln_eta, const double *h, double u_s, double *psi,
                         double *dpsi_dp, double *dpsi_dln_eta, double *dpsi_dh)
{
    return rheology_flow_at(stresses_at, curve, self, n, p, T, ln_eta, h, u_s, psi, dpsi_dp,
                            dpsi_dln_eta, dpsi_dh);
}

static ff_status flow(const void *self, size_t n, const double *ln_eta, const double *h, double u_s,
                      double *psi, double *dpsi_dln_eta, double *dpsi_dh)
{
    const ree_eyring *r = self;
    return rheology_ambient_flow(self, flow_at, isnan(r->tau0), n, ln_eta, h, u_s, psi,
                                 dpsi_dln_eta, dpsi_dh);
}

/* asinh S = ln(1 + u), u = S + S^2/(1 + sqrt(1 + S^2)). ln(1 + u) is computed as u ln(v)/(v - 1),
   where v is 1 + u after rounding; this form loses no digits. */
FF_SIMD_INLINE double arsinh(double S)
{
    double square = S * S, u = S + square / (1 + sqrt(1 + square)), v = 1 + u;
    double scaled = ff_log(v) * (u / (v - 1));
    return v > 1 ? scaled : u;
}

FF_SIMD
static int64_t stresses(double limiting, int moves, size_t n, const double *restrict tau_0,
                        const double *restrict ln_tau0, const double *restrict p,
                        const double *restrict ln_eta, const double *restrict h, double ln_speed,
                        double sign, double *restrict tau)
{
    const double low = moves ? 0 : RHEOLOGY_LIMIT_LEAST, share = moves ? 1 : 0;
    int64_t held = 0;
    for (size_t i = 0; i < n; i++) {
        double tau0 = tau_0[i], ln_slip = ln_speed - ln_tau0[i];
        double ln_S = ln_eta[i] + ln_slip - ff_log(rheology_film(h[i]));
        /* for large S, asinh S = ln 2S; at e^300 both agree to double precision */
        double near = ln_S < 300 ? ln_S : 300;
        double stress = tau0 * (arsinh(ff_exp(near)) + (ln_S > 300 ? ln_S - 300 : 0));
        double plain = stress < STRESS_MAX ? stress : STRESS_MAX;
        tau[i] = sign * rheology_limited(plain, p[i], limiting, low + share * tau0);
        held |= !(stress < STRESS_MAX) | (h[i] < RHEOLOGY_FILM_MIN);
    }
    return held;
}

static ff_status shear_at(const void *self, size_t n, const double *p, const double *T,
                          const double *ln_eta, const double *h, double u_s, double *tau)
{
    const ree_eyring *r = self;
    const double limiting = isnan(r->tau0) ? r->eyring.coefficient : r->limiting_stress_coefficient;
    const double ln_speed = log(fmax(fabs(u_s), 1e-300));
    double tau0[RHEOLOGY_BLOCK], by_p[RHEOLOGY_BLOCK];
    ff_status worst = FF_OK;
    for (size_t i = 0; i < n && u_s == 0; i++)
        tau[i] = 0;
    for (size_t from = 0; from < n && worst >= 0 && u_s != 0; from += RHEOLOGY_BLOCK) {
        size_t count = n - from < RHEOLOGY_BLOCK ? n - from : RHEOLOGY_BLOCK;
        ff_status status = stresses_at(r, count, p + from, T ? T + from : NULL, tau0, by_p);
        logs_of(r, count, tau0, by_p);
        int64_t held = stresses(limiting, isnan(r->tau0), count, tau0, by_p, p + from,
                                ln_eta + from, h + from, ln_speed, u_s < 0 ? -1 : 1, tau + from);
        worst = numerics_worse(worst, numerics_worse(status, held ? FF_DOMAIN : FF_OK));
    }
    return worst;
}

static ff_status shear(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau)
{
    return shear_at(self, n, p, NULL, ln_eta, h, u_s, tau);
}

/* Below this x = |tau|/tau0, sinh and cosh are computed from the series of sinh. */
static const double FLAT = 0.5;

/* sinh(x)/x for x < FLAT, to rounding. */
FF_SIMD_INLINE double flat_sinh(double x)
{
    double y = x * x, s = 1 + y / 210;
    s = 1 + y / 156 * s;
    s = 1 + y / 110 * s;
    s = 1 + y / 72 * s;
    s = 1 + y / 42 * s;
    s = 1 + y / 20 * s;
    return 1 + y / 6 * s;
}

/* The rate is tau0 sinh(x)/eta, x = |tau|/tau0, up to x = y, where it reaches RHEOLOGY_RATE_MAX;
   above, it continues along its tangent. y >= 1 depends on ln(eta), since tau0 e^y/eta is constant;
   the derivative over ln(eta) includes this. `flat` and `steep`: whether points below and above
   FLAT occur. */
FF_SIMD_INLINE int64_t rates_of(rheology_limit limit, size_t n, const double *restrict tau_0,
                                const double *restrict ln_tau0, const double *restrict p,
                                const double *restrict ln_eta, const double *restrict tau,
                                double *restrict rate, double *restrict by_tau,
                                double *restrict by_ln_eta, int flat, int steep)
{
    const double most = RHEOLOGY_TAU_MAX, thin = RHEOLOGY_LN_ETA_MIN;
    const double ln_most = log(2 * RHEOLOGY_RATE_MAX);
    int64_t held = 0;
    for (size_t i = 0; i < n; i++) {
        double tau0 = tau_0[i], top = ln_most - ln_tau0[i];
        double size = tau[i] < 0 ? -tau[i] : tau[i], sign = tau[i] < 0 ? -1 : 1;
        double t = size < most ? size : most, slip_slope;
        double l = ln_eta[i] > thin ? ln_eta[i] : thin, value = 0, slope = 0, fall = 0, beyond = 0;
        double x = t / tau0, moves = 0;
        if (steep) {
            double y = top + l > 1 ? top + l : 1, within = x > y ? y : x;
            moves = top + l > 1 ? 1 : 0;
            beyond = x - within;
            double rise = ff_exp(within - l) / 2;
            fall = ff_exp(-within - l) / 2;
            value = rise - fall;
            slope = rise + fall;
        }
        if (flat) {
            double sinh_x = x * flat_sinh(x), fluidity = ff_exp(-l);
            value = x < FLAT ? sinh_x * fluidity : value;
            slope = x < FLAT ? sqrt(1 + sinh_x * sinh_x) * fluidity : slope;
        }
        double plain = -(value + slope * beyond);
        double slip = rheology_slip(t, p[i], limit, &slip_slope);
        rate[i] = sign * (slip - tau0 * plain);
        by_tau[i] = slope + slip_slope;
        double by_l = moves * beyond > 0 ? 2 * fall - 2 * fall * beyond - slope : plain;
        by_ln_eta[i] = ln_eta[i] > thin ? sign * tau0 * by_l : 0;
        held |= (size > most) | (ln_eta[i] < thin) | (beyond > 0);
    }
    return held;
}

/* Evaluates n <= RUN points, which are often all on the same side of FLAT. */
enum { RUN = 64 };
FF_SIMD
static int64_t rates_of_some(rheology_limit limit, size_t n, const double *restrict tau0,
                             const double *restrict ln_tau0, const double *restrict p,
                             const double *restrict ln_eta, const double *restrict tau,
                             double *restrict rate, double *restrict by_tau,
                             double *restrict by_ln_eta)
{
    int64_t flat = 0, steep = 0;
    for (size_t i = 0; i < n; i++) {
        double size = tau[i] < 0 ? -tau[i] : tau[i];
        int64_t is_flat = size / tau0[i] < FLAT;
        flat |= is_flat;
        steep |= !is_flat;
    }
    if (!steep)
        return rates_of(limit, n, tau0, ln_tau0, p, ln_eta, tau, rate, by_tau, by_ln_eta, 1, 0);
    if (!flat)
        return rates_of(limit, n, tau0, ln_tau0, p, ln_eta, tau, rate, by_tau, by_ln_eta, 0, 1);
    return rates_of(limit, n, tau0, ln_tau0, p, ln_eta, tau, rate, by_tau, by_ln_eta, 1, 1);
}

static ff_status rate(const void *self, size_t n, const double *p, const double *T,
                      const double *ln_eta, const double *tau, double *rate, double *drate_dtau,
                      double *drate_dln_eta)
{
    const ree_eyring *r = self;
    /* if tau0 is auto, the limiting stress acts on the traction only, not on the flow */
    const rheology_limit limit =
        rheology_limit_of(isnan(r->tau0) ? 0 : r->limiting_stress_coefficient);
    double tau0[RUN], by_p[RUN], unwanted[2][RUN];
    ff_status worst = FF_OK;
    for (size_t i = 0; i < n && worst >= 0; i += RUN) {
        size_t count = n - i < RUN ? n - i : RUN;
        ff_status status = stresses_at(r, count, p + i, T ? T + i : NULL, tau0, by_p);
        for (size_t k = 0; k < count; k++)
            tau0[k] = fmax(tau0[k], RHEOLOGY_STRESS_LEAST);
        logs_of(r, count, tau0, by_p);
        int64_t held = rates_of_some(limit, count, tau0, by_p, p + i, ln_eta + i, tau + i, rate + i,
                                     drate_dtau ? drate_dtau + i : unwanted[0],
                                     drate_dln_eta ? drate_dln_eta + i : unwanted[1]);
        worst = numerics_worse(worst, numerics_worse(status, held ? FF_DOMAIN : FF_OK));
    }
    return worst;
}

static const ff_param params[] = {
    FF_QUANTITY_OR(
        "auto", "tau0", "MPa", ree_eyring, tau0, FF_REQUIRED | FF_MIN_OPEN, NULL, NULL, 0, 1e30,
        0.5, 50,
        "Eyring stress, at which shear thinning begins; auto: 2 Lambda/alpha(p, T), with the "
        "secant alpha of the viscosity law; Lambda is limiting_stress_coefficient or follows from "
        "the base oil (mineral 0.047, PAO 0.035, PAG 0.044)"),
    RHEOLOGY_LIMITING_STRESS_ROW(ree_eyring),
};

static ff_status ready(void *self)
{
    ree_eyring *r = self;
    return isnan(r->tau0)
               ? rheology_eyring_ready(r->host, &r->eyring, "tau0", r->limiting_stress_coefficient)
               : FF_OK;
}

RHEOLOGY_3_LAW(
    rheology_ree_eyring, ree_eyring, flow, shear, rate, flow_at, shear_at,
    .id = "rheology/ree-eyring", .version = "1.0.0",
    .summary = "shear thinning as thermally activated flow",
    .reference = "Johnson & Tevaarwerk 1977, Proc. R. Soc. A 356, 215-236; Li & Kahraman 2011, "
                 "Proc. IMechE J, 740-753; " RHEOLOGY_LIMITING_STRESS_REFERENCE,
    .bibtex = BIB_JohnsonTevaarwerk1977 "\n" BIB_LiKahraman2011 "\n" BIB_BairWiner1979,
    .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .ready = ready, .cost = 8e-3);
