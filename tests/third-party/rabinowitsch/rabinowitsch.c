/* SPDX-License-Identifier: MIT */
/*
 * rheology/rabinowitsch: an oil whose shear rate is tau (1 + k tau^2)/eta (Rabinowitsch 1929; in
 * bearings Wada & Hayashi 1971): thickened oils below their limiting stress, slip of polymers.
 *
 * With x = sqrt(k) tau and G = sqrt(k) eta u_s/h the law is x^3 + x = G, whose one real root is
 * x = 2/sqrt(3) sinh(asinh(3 sqrt(3) G/2)/3). psi, the slope of the rate over the stress, is
 * (1 + 3 x^2)/eta.
 */
#include <flankfilm/author.h>
#include <flankfilm/laws.h>

#include <math.h>

typedef struct law {
    const ff_host *host;
    ff_rheology service;
    double stress; /* 1/sqrt(k), Pa */
} law;

/* Beyond any oil and any film the numbers stay where the functions below are finite. */
static const double STEEPEST = 600, THINNEST = 1e-12;

static double within(double value, double low, double high)
{
    return fmax(low, fmin(high, value));
}

static double root_of(double G)
{
    return 1.1547005383792515 * sinh(asinh(2.5980762113533160 * G) / 3);
}

static double driven(const law *l, double ln_eta, double h, double u_s)
{
    return within(exp(within(ln_eta, -STEEPEST, STEEPEST)) * u_s / (l->stress * h), -1e300, 1e300);
}

static ff_status flow(const void *self, size_t n, const double *ln_eta, const double *h, double u_s,
                      double *psi, double *dpsi_dln_eta, double *dpsi_dh)
{
    const law *l = self;
    for (size_t i = 0; i < n; i++) {
        double film = fmax(h[i], THINNEST), x = root_of(driven(l, ln_eta[i], film, u_s));
        double fluidity = exp(-within(ln_eta[i], -STEEPEST, STEEPEST));
        /* d(psi eta)/dln G = 6 x dx/dln G, with dx/dln G = (x + x^3)/(1 + 3 x^2) */
        double growth = 6 * x * x * (1 + x * x) / (1 + 3 * x * x);
        psi[i] = fluidity * (1 + 3 * x * x);
        if (dpsi_dln_eta)
            dpsi_dln_eta[i] = fabs(ln_eta[i]) < STEEPEST ? fluidity * growth - psi[i] : 0;
        if (dpsi_dh)
            dpsi_dh[i] = h[i] > THINNEST ? fmax(-fluidity * growth / film, -1e300) : 0;
    }
    return FF_OK;
}

static ff_status shear(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau)
{
    const law *l = self;
    (void)p;
    for (size_t i = 0; i < n; i++)
        tau[i] = l->stress * root_of(driven(l, ln_eta[i], fmax(h[i], THINNEST), u_s));
    return FF_OK;
}

static const ff_param params[] = {
    FF_QUANTITY("stress", "MPa", law, stress, FF_REQUIRED, NULL, NULL, 1e-3, 1e3, 0.5, 50,
                "1/sqrt(k): the stress at which the oil is twice as fluid as without shear"),
};

FF_RHEOLOGY_LAW(model, law, flow, shear, .id = "rheology/rabinowitsch", .version = "1.0.0",
                .summary = "cubic fluid: a shear rate of tau (1 + (tau/stress)^2)/eta",
                .reference = "Rabinowitsch 1929, Z. Phys. Chem. A 145, 1-26; Wada & Hayashi 1971, "
                             "Bull. JSME 14, 268-278",
                .bibtex = "", .licence = "MIT", .params = FF_TABLE(params));
FF_EXPORT_MODELS(&model);
