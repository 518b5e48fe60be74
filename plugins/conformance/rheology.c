/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a rheology owes: shear makes the film no thicker than a Newtonian one, whichever way it
 * goes. */
#include "kernel.h"
#include "offer.h"

#include <flankfilm/rheology.h>

#include <math.h>

static const double any_pressure[] = {-1e30, -1e10, -1e6, 0, 1e6, 1e9, 1e10, 1e12, 1e30};
static const double any_ln_eta[] = {-1e4, -700, -5, 0, 30, 700, 1e4};
static const double any_film[] = {1e-300, 1e-15, 1e-9, 1e-6, 1, 1e30};

static ff_status flow(const void *table, size_t n, const double *const *in, double speed,
                      double *const *out)
{
    const ff_rheology *law = table;
    return law->flow(law->self, n, in[0], in[1], speed, out[0], out[1], out[2]);
}

static ff_status shear(const void *table, size_t n, const double *const *in, double speed,
                       double *const *out)
{
    const ff_rheology *law = table;
    return law->shear(law->self, n, in[0], in[1], in[2], speed, out[0]);
}

const law_kernel law_kernels[] = {
    {.service = FF_RHEOLOGY_ID,
     .name = "flow",
     .axes = {LN_ETA, FILM},
     .axis_count = 2,
     .results = {"psi", "dpsi_dln_eta", "dpsi_dh"},
     .by = {0, 0, 1},
     .result_count = 3,
     .speeds = {0, 1.5, -1.5},
     .speed_count = 3,
     .positive = true,
     .call = flow},
    {.service = FF_RHEOLOGY_ID,
     .name = "shear",
     .axes = {PRESSURE, LN_ETA, FILM},
     .axis_count = 3,
     .results = {"tau"},
     .result_count = 1,
     .speeds = {0, 1.5, -1.5},
     .speed_count = 3,
     .follows_speed = true,
     .call = shear},
};
const size_t law_kernel_count = sizeof law_kernels / sizeof law_kernels[0];

static ff_status plain_flow(const void *self, size_t n, const double *ln_eta, const double *h,
                            double u_s, double *psi, double *by_ln_eta, double *by_h)
{
    (void)self, (void)h, (void)u_s;
    for (size_t i = 0; i < n; i++) {
        psi[i] = exp(-fmin(fmax(ln_eta[i], -700), 700));
        if (by_ln_eta)
            by_ln_eta[i] = -psi[i];
        if (by_h)
            by_h[i] = 0;
    }
    return FF_OK;
}

static ff_status plain_shear(const void *self, size_t n, const double *p, const double *ln_eta,
                             const double *h, double u_s, double *tau)
{
    (void)self, (void)p;
    for (size_t i = 0; i < n; i++)
        tau[i] = fmin(exp(fmin(ln_eta[i], 700)) / h[i], 1e300) * fmin(fmax(u_s, -1e3), 1e3);
    return FF_OK;
}

static const ff_rheology newtonian_liquid = {sizeof newtonian_liquid, NULL, plain_flow,
                                             plain_shear};

enum { POINTS = 200 };

static int agree(double a, double b)
{
    return fabs(a - b) <= 1e-9 * fmax(fabs(a), fabs(b)) + 1e-300;
}

/* Shear thins: psi >= 1/eta and |tau| <= eta |u_s|/h; psi is even and tau odd in u_s. */
static void check_point(const ff_bench *bench, const ff_rheology *law)
{
    double ln_eta = -7 + 20 * bench->random(bench->ctx), p = 2e9 * bench->random(bench->ctx),
           h = 1e-8 * pow(1e4, bench->random(bench->ctx)), u = 5 * bench->random(bench->ctx), psi,
           psi_back, tau, tau_back, eta = exp(ln_eta);
    law->flow(law->self, 1, &ln_eta, &h, u, &psi, NULL, NULL);
    law->flow(law->self, 1, &ln_eta, &h, -u, &psi_back, NULL, NULL);
    law->shear(law->self, 1, &p, &ln_eta, &h, u, &tau);
    law->shear(law->self, 1, &p, &ln_eta, &h, -u, &tau_back);
    if (!(psi >= (1 - 1e-9) / eta))
        ff_faultf(bench, "flow: psi is %g where 1/eta is %g: less fluid than the Newtonian liquid",
                  psi, 1 / eta);
    else if (!(fabs(tau) <= (1 + 1e-9) * eta * u / h))
        ff_faultf(bench,
                  "shear: tau is %g Pa at eta u_s/h = %g Pa, more than the Newtonian liquid's", tau,
                  eta * u / h);
    else if (!agree(psi, psi_back))
        ff_faultf(bench, "flow: psi is %g at u_s = %g m/s, but %g at the opposite speed", psi, u,
                  psi_back);
    else if (!agree(tau, -tau_back))
        ff_faultf(bench, "shear: tau is %g at u_s = %g m/s, but %g at the opposite speed", tau, u,
                  tau_back);
}

static void newtonian(const ff_bench *bench)
{
    void *instance = bench->open(bench->ctx);
    const ff_rheology *law = instance ? bench->service(bench->ctx, instance, 0) : NULL;
    bench->doing(bench->ctx, "calling flow and shear");
    for (int i = 0; i < POINTS && law; i++)
        check_point(bench, law);
    bench->close(bench->ctx, instance);
}

static const ff_check checks[] = {
    LAW_CHECKS,
    {"newtonian", "shears no stiffer than a Newtonian liquid, the same both ways", newtonian},
};

static const ff_conformance asks = {.size = sizeof asks,
                                    .checks = FF_TABLE(checks),
                                    .service = FF_RHEOLOGY_ID,
                                    .plain = &newtonian_liquid};

static const void *service(void *self, uint32_t output)
{
    (void)self, (void)output;
    return &asks;
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = "conformance/rheology",
    .version = "1.0.0",
    .summary = "what a rheology keeps: finite, pure, shear-thinning, odd in the sliding speed",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .outputs = FF_TABLE(offer_outputs),
    .create = offer_create,
    .service = service,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
