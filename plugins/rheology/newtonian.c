/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newtonian: psi = 1/eta, tau = eta u_s/h. */
#include "film.h"

#include <flankfilm/author.h>
#include <flankfilm/rheology.h>

#include <stdlib.h>

typedef struct newtonian {
    ff_rheology service;
    double limiting_stress_coefficient;
} newtonian;

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
    const newtonian *r = self;
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
        tau[i] = copysign(rheology_limited(plain, p[i], r->limiting_stress_coefficient), u_s);
        outside |= ln_tau > RHEOLOGY_LN_MAX || h[i] < RHEOLOGY_FILM_MIN;
    }
    return outside ? FF_DOMAIN : FF_OK;
}

static const ff_param params[] = {
    {.name = "limiting_stress_coefficient",
     .unit = "1",
     .doc = "the shear stress stays below this times the pressure; not given: no limit",
     .type = FF_REAL,
     .flags = FF_MIN_OPEN,
     .max = 10,
     .low = 0.01,
     .high = 0.15},
};

static const ff_port outputs[] = {
    {.name = "rheology", .unit = "", .doc = "the law", .dims = "", .service = FF_RHEOLOGY_ID}};

static ff_status create(const ff_host *host, void **self)
{
    newtonian *r = calloc(1, sizeof *r);
    (void)host;
    if (!r)
        return FF_NOMEM;
    r->service = (ff_rheology){.size = sizeof r->service, .self = r, .flow = flow, .shear = shear};
    *self = r;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    newtonian *r = self;
    (void)param;
    r->limiting_stress_coefficient = value->real;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    const newtonian *r = self;
    (void)output;
    return &r->service;
}

static ff_status assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        ff_assessment *assessment)
{
    (void)self;
    (void)wanted;
    (void)accuracy;
    (void)in;
    return ff_assess_law(4e-3, "", assessment);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "rheology/newtonian",
    .version = "1.0.0",
    .summary = "shear does not change the viscosity",
    .reference = "Reynolds 1886, Philosophical Transactions 177, 157-234; limiting stress: Bair & "
                 "Winer 1979, J. Lubrication Technology 101, 258-264",
    .bibtex = "@article{Reynolds1886, author={Reynolds, O.}, title={On the theory of lubrication "
              "and its application to Mr. Beauchamp Tower's experiments}, journal={Philosophical "
              "Transactions of the Royal Society of London}, volume={177}, pages={157--234}, "
              "year={1886}}\n"
              "@article{BairWiner1979, author={Bair, S. and Winer, W. O.}, title={A rheological "
              "model for elastohydrodynamic contacts based on primary laboratory data}, "
              "journal={Journal of Lubrication Technology}, volume={101}, pages={258--264}, "
              "year={1979}}",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .inputs = FF_NO_TABLE,
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .service = service,
    .destroy = free,
    .assess = assess,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
