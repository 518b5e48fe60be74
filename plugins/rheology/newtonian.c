/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newtonian: psi = 1/eta, tau = eta u_s/h; the rate at a point is tau/eta. */
#include "law.h"
#include "references.h"

typedef struct newtonian {
    const ff_host *host;
    ff_rheology service;
    ff_rheology_2 service_2;
    double limiting_stress_coefficient;
} newtonian;

FF_SIMD
static int64_t curve(const void *law, size_t n, const double *restrict ln_eta,
                     const double *restrict h, double slip, double *restrict psi,
                     double *restrict by_ln_eta, double *restrict by_h)
{
    int64_t held = 0;
    (void)law, (void)h, (void)slip;
    for (size_t i = 0; i < n; i++) {
        double fluidity = rheology_fluidity(ln_eta[i]);
        psi[i] = fluidity;
        by_ln_eta[i] = ln_eta[i] > -RHEOLOGY_LN_MAX ? -fluidity : 0;
        by_h[i] = 0;
        held |= ln_eta[i] < -RHEOLOGY_LN_MAX;
    }
    return held;
}

static ff_status flow(const void *self, size_t n, const double *ln_eta, const double *h, double u_s,
                      double *psi, double *dpsi_dln_eta, double *dpsi_dh)
{
    (void)u_s;
    return rheology_points(curve, self, n, ln_eta, h, 0, psi, dpsi_dln_eta, dpsi_dh) ? FF_DOMAIN
                                                                                     : FF_OK;
}

FF_SIMD
static int64_t stresses(size_t n, const double *restrict p, const double *restrict ln_eta,
                        const double *restrict h, double ln_speed, double limiting, double sign,
                        double *restrict tau)
{
    int64_t held = 0;
    for (size_t i = 0; i < n; i++) {
        double ln_tau = ln_eta[i] + ln_speed - ff_log(rheology_film(h[i]));
        double plain = ff_exp(ln_tau < RHEOLOGY_LN_MAX ? ln_tau : RHEOLOGY_LN_MAX);
        tau[i] = sign * rheology_limited(plain, p[i], limiting, RHEOLOGY_LIMIT_LEAST);
        held |= (ln_tau > RHEOLOGY_LN_MAX) | (h[i] < RHEOLOGY_FILM_MIN);
    }
    return held;
}

static ff_status shear(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau)
{
    const newtonian *law = self;
    if (u_s == 0) {
        for (size_t i = 0; i < n; i++)
            tau[i] = 0;
        return FF_OK;
    }
    return stresses(n, p, ln_eta, h, log(fabs(u_s)), law->limiting_stress_coefficient,
                    u_s < 0 ? -1 : 1, tau)
               ? FF_DOMAIN
               : FF_OK;
}

FF_SIMD
static int64_t rates(const void *self, size_t n, const double *restrict p,
                     const double *restrict ln_eta, const double *restrict tau,
                     double *restrict rate, double *restrict by_tau, double *restrict by_ln_eta)
{
    const double most = RHEOLOGY_TAU_MAX, thin = RHEOLOGY_LN_ETA_MIN;
    const rheology_limit limit =
        rheology_limit_of(((const newtonian *)self)->limiting_stress_coefficient);
    int64_t held = 0;
    for (size_t i = 0; i < n; i++) {
        double size = tau[i] < 0 ? -tau[i] : tau[i], sign = tau[i] < 0 ? -1 : 1;
        double t = size < most ? size : most, slip_slope;
        double l = ln_eta[i] > thin ? ln_eta[i] : thin, fluidity = ff_exp(-l);
        double slip = rheology_slip(t, p[i], limit, &slip_slope);
        rate[i] = sign * (t * fluidity + slip);
        by_tau[i] = fluidity + slip_slope;
        by_ln_eta[i] = ln_eta[i] > thin ? -sign * t * fluidity : 0;
        held |= (size > most) | (ln_eta[i] < thin);
    }
    return held;
}

static ff_status rate(const void *self, size_t n, const double *p, const double *T,
                      const double *ln_eta, const double *tau, double *rate, double *drate_dtau,
                      double *drate_dln_eta)
{
    (void)T;
    return rheology_rates(rates, self, n, p, ln_eta, tau, rate, drate_dtau, drate_dln_eta);
}

static const ff_param params[] = {
    RHEOLOGY_LIMITING_STRESS_ROW(newtonian),
};

FF_RHEOLOGY_2_LAW(rheology_newtonian, newtonian, flow, shear, rate, .id = "rheology/newtonian",
                  .version = "1.0.0", .summary = "shear does not change the viscosity",
                  .reference = "Reynolds 1886, Philosophical Transactions 177, "
                               "157-234; " RHEOLOGY_LIMITING_STRESS_REFERENCE,
                  .bibtex = BIB_Reynolds1886 "\n" BIB_BairWiner1979, .licence = "GPL-3.0-or-later",
                  .params = FF_TABLE(params), .cost = 4e-3);
