/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Ree-Eyring: the mean shear stress is tau_m = tau0 asinh(S), S = eta u_s/(tau0 h), and the
 * pressure flow is eased by cosh(tau_m/tau0) (Li & Kahraman 2011, eq. 8a), so that
 *   psi = cosh(asinh S)/eta = sqrt(1/eta^2 + (u_s/(tau0 h))^2).
 */
#include "law.h"
#include "references.h"

static const double STRESS_MAX = 1e300; /* Pa */

typedef struct ree_eyring {
    const ff_host *host;
    ff_rheology service;
    double limiting_stress_coefficient;
    double tau0; /* Pa */
} ree_eyring;

FF_SIMD
static int64_t curve(const void *law, size_t n, const double *restrict ln_eta,
                     const double *restrict h, double slip, double *restrict psi,
                     double *restrict by_ln_eta, double *restrict by_h)
{
    int64_t held = 0;
    (void)law;
    for (size_t i = 0; i < n; i++) {
        double film = rheology_film(h[i]);
        double a = rheology_fluidity(ln_eta[i]), s = slip / film;
        double most = a > s ? a : s, least = a > s ? s : a, ratio = least / most;
        double root = most * sqrt(1 + ratio * ratio);
        double by_eta = -a * (a / root), by_film = -s * (s / root) / film;
        psi[i] = root;
        by_ln_eta[i] = ln_eta[i] > -RHEOLOGY_LN_MAX ? by_eta : 0;
        by_h[i] = h[i] > RHEOLOGY_FILM_MIN ? by_film : 0;
        held |= (ln_eta[i] < -RHEOLOGY_LN_MAX) | (h[i] < RHEOLOGY_FILM_MIN);
    }
    return held;
}

static ff_status flow(const void *self, size_t n, const double *ln_eta, const double *h, double u_s,
                      double *psi, double *dpsi_dln_eta, double *dpsi_dh)
{
    const ree_eyring *r = self;
    const double slip = fmin(fabs(u_s) / r->tau0, 1e100);
    int64_t held = rheology_points(curve, r, n, ln_eta, h, slip, psi, dpsi_dln_eta, dpsi_dh);
    return held || slip == 1e100 ? FF_DOMAIN : FF_OK;
}

static ff_status shear(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau)
{
    const ree_eyring *r = self;
    int outside = 0;
    if (u_s == 0) {
        for (size_t i = 0; i < n; i++)
            tau[i] = 0;
        return FF_OK;
    }
    const double ln_slip = log(fabs(u_s)) - log(r->tau0);
    for (size_t i = 0; i < n; i++) {
        double ln_S = ln_eta[i] + ln_slip - log(rheology_film(h[i]));
        /* asinh S = ln 2S where S is large; the cut at e^300 is exact in double precision */
        double rise = asinh(exp(fmin(ln_S, 300))) + fmax(ln_S - 300, 0);
        double plain = fmin(r->tau0 * rise, STRESS_MAX);
        tau[i] = copysign(rheology_limited(plain, p[i], r->limiting_stress_coefficient), u_s);
        outside |= plain == STRESS_MAX || h[i] < RHEOLOGY_FILM_MIN;
    }
    return outside ? FF_DOMAIN : FF_OK;
}

static const ff_param params[] = {
    FF_QUANTITY("tau0", "MPa", ree_eyring, tau0, FF_REQUIRED | FF_MIN_OPEN, NULL, NULL, 0, 1e30,
                0.5, 50, "Eyring stress, where shear thinning sets in"),
    RHEOLOGY_LIMITING_STRESS_ROW(ree_eyring),
};

FF_RHEOLOGY_LAW(rheology_ree_eyring, ree_eyring, flow, shear, .id = "rheology/ree-eyring",
                .version = "1.0.0", .summary = "shear thinning by a thermally activated flow",
                .reference =
                    "Johnson & Tevaarwerk 1977, Proc. R. Soc. A 356, 215-236; Li & Kahraman 2011, "
                    "Proc. IMechE J, 740-753; " RHEOLOGY_LIMITING_STRESS_REFERENCE,
                .bibtex = BIB_JohnsonTevaarwerk1977 "\n" BIB_LiKahraman2011 "\n" BIB_BairWiner1979,
                .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .cost = 8e-3);
