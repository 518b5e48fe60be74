/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Isoviscous: eta = eta0. */
#include "law.h"

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const viscosity_law *law = self;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = law->ln_eta0;
        if (dln_dp)
            dln_dp[i] = 0;
    }
    return viscosity_law_end(law, n, p, dln_dT);
}

static const ff_param params[] = {VISCOSITY_LAW_ROWS};

static ff_status create(const ff_host *host, void **self)
{
    return viscosity_law_create(host, sizeof(viscosity_law), 6e-4, eval, self);
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    return viscosity_law_set(self, param, value);
}

static ff_status ready(void *self)
{
    return viscosity_law_ready(self, viscosity_highest_cap);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "viscosity/isoviscous",
    .version = "1.0.0",
    .summary = "viscosity that pressure does not change",
    .reference = "Martin 1916, Engineering 102, 119-121",
    .bibtex = "@article{Martin1916, author={Martin, H. M.}, title={Lubrication of gear teeth}, "
              "journal={Engineering}, volume={102}, pages={119--121}, year={1916}}",
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
