/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newtonian: psi = 1/eta, tau = eta u_s/h. */
#include "law.h"

#include <stdlib.h>

static ff_status flow(const void *self, size_t n, const double *ln_eta, const double *h, double u_s,
                      double *psi, double *dpsi_dln_eta, double *dpsi_dh)
{
    int outside = 0;
    (void)self;
    (void)h;
    (void)u_s;
    for (size_t i = 0; i < n; i++) {
        psi[i] = rheology_fluidity(ln_eta[i]);
        if (dpsi_dln_eta)
            dpsi_dln_eta[i] = ln_eta[i] > -RHEOLOGY_LN_MAX ? -psi[i] : 0;
        if (dpsi_dh)
            dpsi_dh[i] = 0;
        outside |= ln_eta[i] < -RHEOLOGY_LN_MAX;
    }
    return outside ? FF_DOMAIN : FF_OK;
}

static ff_status shear(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau)
{
    const rheology_law *law = self;
    int outside = 0;
    if (u_s == 0) {
        for (size_t i = 0; i < n; i++)
            tau[i] = 0;
        return FF_OK;
    }
    const double ln_speed = log(fabs(u_s));
    for (size_t i = 0; i < n; i++) {
        double ln_tau = ln_eta[i] + ln_speed - log(rheology_film(h[i]));
        double plain = exp(fmin(ln_tau, RHEOLOGY_LN_MAX));
        tau[i] = copysign(rheology_limited(plain, p[i], law->limiting_stress_coefficient), u_s);
        outside |= ln_tau > RHEOLOGY_LN_MAX || h[i] < RHEOLOGY_FILM_MIN;
    }
    return outside ? FF_DOMAIN : FF_OK;
}

static const ff_param params[] = {
    RHEOLOGY_LIMITING_STRESS_ROW,
};

static ff_status create(const ff_host *host, void **self)
{
    (void)host;
    return rheology_law_create(sizeof(rheology_law), 4e-3, flow, shear, self);
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    rheology_law *law = self;
    (void)param;
    law->limiting_stress_coefficient = value->real;
    return FF_OK;
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "rheology/newtonian",
    .version = "1.0.0",
    .summary = "shear does not change the viscosity",
    .reference = "Reynolds 1886, Philosophical Transactions 177, "
                 "157-234; " RHEOLOGY_LIMITING_STRESS_REFERENCE,
    .bibtex = "@article{Reynolds1886, author={Reynolds, O.}, title={On the theory of lubrication "
              "and its application to Mr. Beauchamp Tower's experiments}, journal={Philosophical "
              "Transactions of the Royal Society of London}, volume={177}, pages={157--234}, "
              "year={1886}}\n" RHEOLOGY_LIMITING_STRESS_BIBTEX,
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(rheology_law_outputs),
    .create = create,
    .set = set,
    .service = rheology_law_service,
    .destroy = free,
    .assess = rheology_law_assess,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
