/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Carreau 1972 in the form of Bair: tau = eta g [1 + (eta g/G)^2]^((n - 1)/2), g = u_s/h. The
   pressure flow in the direction of sliding depends on the slope of this curve, as with Ree-Eyring:
   psi = dg/dtau = (1 + S^2)^((3 - n)/2) / (eta (1 + n S^2)), S = eta g/G. At a point, the rate g is
   found from the stress tau. */
#include "law.h"
#include "references.h"

#include "../numerics/liquid.h"

static const double STRESS_MAX = 1e300; /* Pa */

typedef struct carreau {
    const ff_host *host;
    ff_rheology service;
    ff_rheology_2 service_2;
    ff_rheology_3 service_3;
    rheology_eyring eyring;
    double limiting_stress_coefficient;
    double G, n; /* Pa, 1; G NaN: auto */
} carreau;

/* Ratio of G to the Eyring stress for which the law with n = 0.27 follows Ree-Eyring within 5 %,
 * up to five times that stress. */
static const double over_eyring = 1.86, fitted_n = 0.27;

/* G and its slope over p at n <= RHEOLOGY_BLOCK points. */
static ff_status stresses_at(const void *self, size_t n, const double *p, const double *T,
                             double *G, double *by_p)
{
    const carreau *c = self;
    ff_status status = FF_OK;
    if (isnan(c->G))
        status = rheology_eyring_stress(&c->eyring, n, p, T, G, by_p);
    for (size_t i = 0; i < n; i++) {
        G[i] = isnan(c->G) ? over_eyring * G[i] : c->G;
        by_p[i] = isnan(c->G) ? over_eyring * by_p[i] : 0;
    }
    return status;
}

static double limit_of(const carreau *c)
{
    return isnan(c->G) ? c->eyring.coefficient : c->limiting_stress_coefficient;
}

/* ln(1 + e^x) */
static double log_one_more(double x)
{
    return x > 0 ? x + log1p(exp(-x)) : log1p(exp(x));
}

/* Returns ln S, clamped so that its multiples stay finite. */
static double ln_strain(double G, double ln_eta, double h, double u_s)
{
    double x = ln_eta + log(fabs(u_s)) - log(rheology_film(h)) - log(G);
    return fmin(fmax(x, -1e6), 1e6);
}

/* psi and its derivatives over ln(eta) and ln(h). Returns 1 if psi was clamped to e^-690 or
 * e^690. */
static int fluidity(const carreau *c, double ln_eta, double ln_S, double *psi, double *by_eta,
                    double *by_h)
{
    const double n = c->n;
    double much = log_one_more(2 * ln_S), more = log_one_more(2 * ln_S + log(n));
    double ln_psi = (3 - n) / 2 * much - more - ln_eta;
    /* S^2/(1 + S^2) = exp(2 ln S - much) */
    double slope = (3 - n) * exp(2 * ln_S - much) - 2 * n * exp(2 * ln_S - more);
    int held = ln_psi > RHEOLOGY_LN_MAX;
    *psi = exp(held ? RHEOLOGY_LN_MAX : ln_psi);
    *by_eta = held ? 0 : *psi * (slope - 1);
    *by_h = held ? 0 : -*psi * slope;
    return held;
}

/* Evaluates one block. On entry by_p is the slope of G over p, on return that of psi. */
static int64_t flow_some(const void *law, double u_s, size_t count, const double *G,
                         const double *ln_eta, const double *h, double *psi, double *by_p,
                         double *dpsi_dln_eta, double *dpsi_dh)
{
    int64_t outside = 0;
    for (size_t i = 0; i < count; i++) {
        double l = fmax(ln_eta[i], -RHEOLOGY_LN_MAX), by_eta, by_h;
        int thin = h[i]<RHEOLOGY_FILM_MIN, weak = l> ln_eta[i];
        double ln_S = u_s != 0 ? ln_strain(G[i], fmin(l, 1e6), h[i], u_s) : -1e6;
        outside |= fluidity(law, fmin(l, 1e6), ln_S, &psi[i], &by_eta, &by_h) || thin || weak;
        by_p[i] *= by_h / G[i]; /* G and h enter S in the same way */
        dpsi_dln_eta[i] = weak ? 0 : by_eta;
        dpsi_dh[i] = thin ? 0 : by_h / rheology_film(h[i]);
    }
    return outside;
}

static ff_status flow_at(const void *self, size_t n, const double *p, const double *T,
                         const double *ln_eta, const double *h, double u_s, double *psi,
                         double *dpsi_dp, double *dpsi_dln_eta, double *dpsi_dh)
{
    return rheology_flow_at(stresses_at, flow_some, self, n, p, T, ln_eta, h, u_s, psi, dpsi_dp,
                            dpsi_dln_eta, dpsi_dh);
}

static ff_status flow(const void *self, size_t n, const double *ln_eta, const double *h, double u_s,
                      double *psi, double *dpsi_dln_eta, double *dpsi_dh)
{
    const carreau *c = self;
    return rheology_ambient_flow(self, flow_at, isnan(c->G), n, ln_eta, h, u_s, psi, dpsi_dln_eta,
                                 dpsi_dh);
}

static ff_status shear_at(const void *self, size_t count, const double *p, const double *T,
                          const double *ln_eta, const double *h, double u_s, double *tau)
{
    const carreau *c = self;
    const double ln_most = log(STRESS_MAX);
    double G[RHEOLOGY_BLOCK], by_p[RHEOLOGY_BLOCK];
    ff_status worst = FF_OK;
    int outside = 0;
    for (size_t i = 0; i < count; i++) {
        const size_t k = i % RHEOLOGY_BLOCK, left = count - i;
        if (k == 0 && u_s != 0)
            worst =
                numerics_worse(worst, stresses_at(c, left < RHEOLOGY_BLOCK ? left : RHEOLOGY_BLOCK,
                                                  p + i, T ? T + i : NULL, G, by_p));
        if (u_s == 0) {
            tau[i] = 0;
            continue;
        }
        double ln_S = ln_strain(G[k], ln_eta[i], h[i], u_s);
        double ln_tau = log(G[k]) + ln_S + (c->n - 1) / 2 * log_one_more(2 * ln_S);
        double plain = exp(fmin(ln_tau, ln_most));
        double least = isnan(c->G) ? G[k] / over_eyring : RHEOLOGY_LIMIT_LEAST;
        tau[i] = copysign(rheology_limited(plain, p[i], limit_of(c), least), u_s);
        outside |= ln_tau > ln_most || h[i] < RHEOLOGY_FILM_MIN;
    }
    return numerics_worse(worst, outside ? FF_DOMAIN : FF_OK);
}

static ff_status shear(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau)
{
    return shear_at(self, n, p, NULL, ln_eta, h, u_s, tau);
}

/* ln(tau/G) as a function of y = ln S, with its first (slope) and second derivative (bend). */
typedef struct stress {
    double ln, slope, bend;
} stress;

static stress stress_at(double n, double y)
{
    double share = 1 / (1 + exp(fmin(-2 * y, 700))); /* S^2/(1 + S^2) */
    return (stress){.ln = y + (n - 1) / 2 * log_one_more(2 * y),
                    .slope = 1 + (n - 1) * share,
                    .bend = 2 * (n - 1) * share * (1 - share)};
}

/* Returns y = ln S for the stress ln(tau/G) = ln_T. The stress rises with y, is concave, and lies
   below both asymptotes. Newton steps from the larger root of the asymptotes therefore never
   overshoot. */
static double find_ln_strain(double n, double ln_T)
{
    double y = fmax(ln_T, ln_T / n), step = 1;
    for (int i = 0; i < 60 && fabs(step) > 1e-8; i++) {
        stress at = stress_at(n, y);
        step = (ln_T - at.ln) / at.slope;
        y += step;
    }
    return y;
}

/* The rate for a stress, and its derivatives. Above RHEOLOGY_RATE_MAX, where ln S = most, the rate
   continues along its tangent; `most` depends on ln(eta). */
typedef struct sheared {
    double rate, by_tau, by_ln_eta;
    int held;
} sheared;

static sheared rate_at(const carreau *c, double thinning, double ln_eta, double tau)
{
    const double G = fmax(thinning, RHEOLOGY_STRESS_LEAST), top = log(RHEOLOGY_RATE_MAX / G);
    const double most = fmax(1, top + ln_eta);
    stress last = stress_at(c->n, most);
    double ln_T = log(tau / G), fluidity = exp(-ln_eta);
    if (tau <= 0 || ln_T < -300)
        return (sheared){.rate = tau * fluidity, .by_tau = fluidity, .by_ln_eta = -tau * fluidity};
    double y = ln_T < last.ln ? find_ln_strain(c->n, ln_T) : most;
    stress at = stress_at(c->n, y);
    double rate = G * exp(y - ln_eta), end = G * exp(fmin(at.ln, ln_T)), ratio = tau / end;
    double by_tau = rate / (end * at.slope);
    sheared s = {.rate = rate, .by_tau = by_tau, .by_ln_eta = -rate, .held = ln_T > last.ln};
    if (!s.held)
        return s;
    s.rate = rate * (1 + (ratio - 1) / at.slope);
    s.by_ln_eta =
        most > 1 ? -rate * (ratio + (ratio - 1) * at.bend / (at.slope * at.slope)) : -s.rate;
    return s;
}

static ff_status rate(const void *self, size_t n, const double *p, const double *T,
                      const double *ln_eta, const double *tau, double *rate, double *drate_dtau,
                      double *drate_dln_eta)
{
    const carreau *c = self;
    /* if G is auto, the limiting stress acts on the traction only, not on the flow */
    const rheology_limit limit =
        rheology_limit_of(isnan(c->G) ? 0 : c->limiting_stress_coefficient);
    double G[RHEOLOGY_BLOCK], by_p[RHEOLOGY_BLOCK];
    ff_status worst = FF_OK;
    int outside = 0;
    for (size_t i = 0; i < n; i++) {
        const size_t k = i % RHEOLOGY_BLOCK, left = n - i;
        if (k == 0)
            worst =
                numerics_worse(worst, stresses_at(c, left < RHEOLOGY_BLOCK ? left : RHEOLOGY_BLOCK,
                                                  p + i, T ? T + i : NULL, G, by_p));
        double size = fmin(fabs(tau[i]), RHEOLOGY_TAU_MAX), slip_slope;
        int thin = ln_eta[i] < RHEOLOGY_LN_ETA_MIN;
        sheared s = rate_at(c, G[k], fmin(fmax(ln_eta[i], RHEOLOGY_LN_ETA_MIN), 1e6), size);
        double slip = rheology_slip(size, p[i], limit, &slip_slope);
        rate[i] = copysign(s.rate + slip, tau[i]);
        if (drate_dtau)
            drate_dtau[i] = s.by_tau + slip_slope;
        if (drate_dln_eta)
            drate_dln_eta[i] = thin ? 0 : copysign(1, tau[i]) * s.by_ln_eta;
        outside |= s.held || thin || fabs(tau[i]) > RHEOLOGY_TAU_MAX;
    }
    return numerics_worse(worst, outside ? FF_DOMAIN : FF_OK);
}

static const ff_param params[] = {
    FF_QUANTITY_OR("auto", "G", "MPa", carreau, G, FF_REQUIRED | FF_MIN_OPEN, NULL, NULL, 0, 1e30,
                   0.01, 50,
                   "stress at which shear thinning begins; auto: 1.86 times the Eyring stress 2 "
                   "Lambda/alpha(p, T) of ree-eyring; with n = 0.27 the law then follows "
                   "Ree-Eyring within 5 %"),
    FF_QUANTITY(
        "n", "1", carreau, n, FF_REQUIRED, NULL, NULL, 0.01, 1, 0.2, 1,
        "shear-thinning exponent n: tau is proportional to rate^n at high rates; 1: Newtonian"),
    RHEOLOGY_LIMITING_STRESS_ROW(carreau),
};

static ff_status ready(void *self)
{
    carreau *c = self;
    if (!isnan(c->G))
        return FF_OK;
    ff_status status =
        rheology_eyring_ready(c->host, &c->eyring, "G", c->limiting_stress_coefficient);
    if (status == FF_OK && fabs(c->n - fitted_n) > 0.01)
        return ff_failf(c->host, FF_UNSUPPORTED, "G",
                        "G: auto fits the Eyring stress for n = %g only, but n is %g; give G",
                        fitted_n, c->n);
    return status;
}

RHEOLOGY_3_LAW(
    rheology_carreau, carreau, flow, shear, rate, flow_at, shear_at, .id = "rheology/carreau",
    .version = "1.0.0", .summary = "shear thinning by a power law above a stress G",
    .reference = "Carreau 1972, Trans. Soc. Rheology 16, 99-127; Bair 2007, High-Pressure Rheology "
                 "for Quantitative Elastohydrodynamics; " RHEOLOGY_LIMITING_STRESS_REFERENCE,
    .bibtex = BIB_Carreau1972 "\n" BIB_Bair2007 "\n" BIB_BairWiner1979,
    .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .ready = ready, .cost = 5.4e-2);
