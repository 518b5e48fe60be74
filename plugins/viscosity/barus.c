/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Barus: eta = eta0 exp(alpha p). */
#include "law.h"

typedef struct barus {
    viscosity_law law;
    double alpha; /* 1/Pa */
} barus;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const barus *b = self;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = b->law.ln_eta0 + b->alpha * p[i];
        if (dln_dp)
            dln_dp[i] = b->alpha;
    }
    return viscosity_law_end(&b->law, n, p, dln_dT);
}

static const ff_param params[] = {
    VISCOSITY_LAW_ROWS,
    {.name = "alpha",
     .unit = "1/GPa",
     .type = FF_REAL,
     .doc = "pressure-viscosity coefficient",
     .flags = FF_REQUIRED,
     .max = 1000,
     .low = 2,
     .high = 50},
};

static ff_status create(const ff_host *host, void **self)
{
    return viscosity_law_create(host, sizeof(barus), 7e-4, eval, self);
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    barus *b = self;
    if (param < VISCOSITY_LAW_PARAMS)
        return viscosity_law_set(&b->law, param, value);
    b->alpha = value->real;
    return FF_OK;
}

static ff_status ready(void *self)
{
    return viscosity_law_ready(self, viscosity_highest_cap);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "viscosity/barus",
    .version = "1.0.0",
    .summary = "exponential rise of viscosity with pressure; too steep above some 0.5 GPa",
    .reference = "Barus 1893, American Journal of Science 45, 87-96",
    .bibtex = "@article{Barus1893, author={Barus, C.}, title={Isothermals, isopiestics and "
              "isometrics relative to viscosity}, journal={American Journal of Science}, "
              "volume={45}, pages={87--96}, year={1893}}",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(viscosity_law_outputs),
    .create = create,
    .set = set,
    .ready = ready,
    .service = viscosity_law_service,
    .destroy = viscosity_law_destroy,
    .assess = viscosity_law_assess,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
