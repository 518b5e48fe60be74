/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions shared by the rheology laws: limiting stress, stress of shear thinning, and
   services. */
#include "law.h"

#include "../numerics/liquid.h"

const ff_port rheology_inputs[RHEOLOGY_INPUTS] = {
    [RHEOLOGY_IN_VISCOSITY] = {.name = "viscosity",
                               .unit = "",
                               .doc = "viscosity of the oil; needed if the stress is auto",
                               .dims = "",
                               .service = FF_VISCOSITY_ID,
                               .flags = FF_OPTIONAL},
    [RHEOLOGY_IN_OIL] = {.name = "oil",
                         .unit = "",
                         .doc =
                             "the oil, whose base oil determines the limiting stress coefficient",
                         .dims = "",
                         .service = FF_LIQUID_ID,
                         .flags = FF_OPTIONAL,
                         .from = "lubricant"},
};

const ff_port rheology_outputs[RHEOLOGY_OUTPUTS] = {
    {.name = "rheology", .unit = "", .doc = "the law", .dims = "", .service = FF_RHEOLOGY_ID},
    {.name = "rate",
     .unit = "",
     .doc = "shear rate over shear stress",
     .dims = "",
     .service = FF_RHEOLOGY_2_ID},
    {.name = "at_pressure",
     .unit = "",
     .doc = "the law, with stresses as functions of pressure and temperature",
     .dims = "",
     .service = FF_RHEOLOGY_3_ID},
};

ff_status rheology_eyring_wire(rheology_eyring *e, uint32_t input, const void *service)
{
    if (input == RHEOLOGY_IN_VISCOSITY)
        e->viscosity = service;
    else
        e->oil = service;
    return FF_OK;
}

ff_status rheology_eyring_ready(const ff_host *host, rheology_eyring *e, const char *name,
                                double given)
{
    /* Arana, Larranaga & Ulacia 2019, tables 2 and 3, 20 to 100 degC */
    static const double of_base[] = {[FF_BASE_MINERAL] = 0.047,
                                     [FF_BASE_PAO] = 0.035,
                                     [FF_BASE_ESTER] = 0,
                                     [FF_BASE_PAG] = 0.044};
    double T = 313.15, base = NAN;
    e->coefficient = given;
    if (!e->viscosity)
        return ff_failf(host, FF_INVALID, name,
                        "%s: auto needs the viscosity as a function of pressure: wire a stage of "
                        "the kind viscosity, or give a stress",
                        name);
    if (e->oil && e->oil->eval(e->oil->self, FF_LIQUID_BASE, 1, &T, &base, NULL) < 0)
        base = NAN;
    if (isnan(given) && base >= 0 && base <= FF_BASE_PAG)
        e->coefficient = of_base[(int)base];
    if (e->coefficient > 0)
        return FF_OK;
    return ff_failf(host, FF_INVALID, name,
                    "%s: auto needs limiting_stress_coefficient, which is known for mineral oils, "
                    "PAO and PAG only; give it, or a stress",
                    name);
}

/* Computes the stress from the secant of ln(eta) over p. Below 1 MPa, where the secant loses
   digits, the mean of the slopes at both ends is used, with an error of p^2/12 times the third
   derivative. If the viscosity does not rise with pressure, the stress is so large that it has no
   effect. */
FF_SIMD
static void fill_stress(double twice, size_t n, const double *restrict p,
                        const double *restrict ln_eta, const double *restrict slope,
                        const double *restrict ambient, const double *restrict first,
                        double *restrict stress, double *restrict by_p)
{
    const double low = 1e6, least = 1e-13;
    for (size_t i = 0; i < n; i++) {
        double q = p[i] > 1 ? p[i] : 1;
        double mean = (first[i] + slope[i]) / 2, bend = (slope[i] - first[i]) / (2 * q);
        double ratio = (ln_eta[i] - ambient[i]) / q;
        double secant = p[i] < low ? mean : ratio, by = p[i] < low ? bend : (slope[i] - ratio) / q;
        double held = secant > least ? secant : least;
        stress[i] = twice / held;
        by_p[i] = secant > least && p[i] > 1 ? -stress[i] / held * by : 0;
    }
}

ff_status rheology_eyring_stress(const rheology_eyring *e, size_t n, const double *p,
                                 const double *T, double *stress, double *by_p)
{
    static const double none[RHEOLOGY_BLOCK];
    double ln_eta[RHEOLOGY_BLOCK], slope[RHEOLOGY_BLOCK], ambient[RHEOLOGY_BLOCK],
        first[RHEOLOGY_BLOCK];
    const ff_viscosity *v = e->viscosity;
    const size_t one = numerics_is_uniform(n, T) && n > 1 ? 1 : n;
    ff_status status = v->eval(v->self, n, p, T, ln_eta, slope, NULL);
    status = numerics_worse(status, v->eval(v->self, one, none, T, ambient, first, NULL));
    for (size_t i = one; i < n; i++) {
        ambient[i] = ambient[0];
        first[i] = first[0];
    }
    fill_stress(2 * e->coefficient, n, p, ln_eta, slope, ambient, first, stress, by_p);
    /* the direct caller of the viscosity law is told if the viscosity is extrapolated */
    return status == FF_DOMAIN ? FF_OK : status;
}

ff_status rheology_flow_at(rheology_stresses *stresses, rheology_some *some, const void *law,
                           size_t n, const double *p, const double *T, const double *ln_eta,
                           const double *h, double u_s, double *psi, double *dpsi_dp,
                           double *dpsi_dln_eta, double *dpsi_dh)
{
    double stress[RHEOLOGY_BLOCK], by_p[RHEOLOGY_BLOCK], unwanted[2][RHEOLOGY_BLOCK];
    ff_status worst = FF_OK;
    for (size_t from = 0; from < n && worst >= 0; from += RHEOLOGY_BLOCK) {
        size_t count = n - from < RHEOLOGY_BLOCK ? n - from : RHEOLOGY_BLOCK;
        ff_status status = stresses(law, count, p + from, T ? T + from : NULL, stress, by_p);
        int64_t held = some(law, u_s, count, stress, ln_eta + from, h + from, psi + from, by_p,
                            dpsi_dln_eta ? dpsi_dln_eta + from : unwanted[0],
                            dpsi_dh ? dpsi_dh + from : unwanted[1]);
        for (size_t i = 0; i < count && dpsi_dp; i++)
            dpsi_dp[from + i] = by_p[i];
        worst = numerics_worse(worst, numerics_worse(status, held ? FF_DOMAIN : FF_OK));
    }
    return worst;
}

ff_status rheology_ambient_flow(const void *self, rheology_flow_3 *flow, int moves, size_t n,
                                const double *ln_eta, const double *h, double u_s, double *psi,
                                double *by_ln_eta, double *by_h)
{
    static const double none[RHEOLOGY_BLOCK];
    ff_status worst = moves ? FF_DOMAIN : FF_OK;
    for (size_t from = 0; from < n && worst >= 0; from += RHEOLOGY_BLOCK)
        worst = numerics_worse(
            worst, flow(self, n - from < RHEOLOGY_BLOCK ? n - from : RHEOLOGY_BLOCK, none, NULL,
                        ln_eta + from, h + from, u_s, psi + from, NULL,
                        by_ln_eta ? by_ln_eta + from : NULL, by_h ? by_h + from : NULL));
    return worst;
}

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
