/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "law.h"

int64_t rheology_points(rheology_curve *curve, const void *law, size_t n, const double *ln_eta,
                        const double *h, double slip, double *psi, double *by_ln_eta, double *by_h)
{
    enum { BLOCK = 256 };
    double unwanted[BLOCK], unwanted_too[BLOCK];
    int64_t held = 0;
    for (size_t from = 0; from < n; from += BLOCK)
        held |= curve(law, n - from < BLOCK ? n - from : BLOCK, ln_eta + from, h + from, slip,
                      psi + from, by_ln_eta ? by_ln_eta + from : unwanted,
                      by_h ? by_h + from : unwanted_too);
    return held;
}

ff_status rheology_rates(rheology_rate *curve, const void *law, size_t n, const double *p,
                         const double *ln_eta, const double *tau, double *rate, double *by_tau,
                         double *by_ln_eta)
{
    enum { BLOCK = 256 };
    double unwanted[BLOCK], unwanted_too[BLOCK];
    int64_t held = 0;
    for (size_t from = 0; from < n; from += BLOCK)
        held |= curve(law, n - from < BLOCK ? n - from : BLOCK, p + from, ln_eta + from, tau + from,
                      rate + from, by_tau ? by_tau + from : unwanted,
                      by_ln_eta ? by_ln_eta + from : unwanted_too);
    return held ? FF_DOMAIN : FF_OK;
}
