/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Two slopes: ln(eta/eta0) rises by alpha_1 up to the transition and by alpha_2 above it (Allen,
 * Townsend & Zaretsky 1970). Over `transition_width` the slope goes linearly from one to the
 * other, which is the cubic of Goglia, Cusano & Conry 1984 for a transition in its middle.
 */
#include "law.h"

typedef struct two_slope {
    viscosity_law law;
    double alpha_1, alpha_2, middle, width; /* 1/Pa, Pa */
} two_slope;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const two_slope *t = self;
    const double change = t->alpha_2 - t->alpha_1, width = t->width, cap = t->law.pressure_cap;
    const double begin = t->middle - width / 2, end = t->middle + width / 2;
    const double part = width > 0 ? 1 / width : 0;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        double q = viscosity_law_clip(p[i], cap);
        double over = q > end ? q - end : 0, in = q > begin ? q - begin : 0;
        double inside = in < width ? in : width;
        /* at a transition of width 0 the upper slope holds */
        double share = q >= end ? 1 : inside * part;
        double slope = t->alpha_1 + change * share;
        ln_eta[i] = t->law.ln_eta0 + t->alpha_1 * q + change * (over + inside * inside * part / 2) +
                    slope * (p[i] - q);
        if (dln_dp)
            dln_dp[i] = slope;
    }
    return viscosity_law_end(&t->law, n, p, dln_dT);
}

static const ff_param params[] = {
    VISCOSITY_LAW_ROWS,
    {.name = "alpha_1",
     .unit = "1/GPa",
     .type = FF_REAL,
     .doc = "pressure-viscosity coefficient below the transition",
     .flags = FF_REQUIRED,
     .max = 1000,
     .low = 2,
     .high = 50},
    {.name = "alpha_2",
     .unit = "1/GPa",
     .type = FF_REAL,
     .doc = "pressure-viscosity coefficient above the transition",
     .flags = FF_REQUIRED,
     .max = 1000,
     .low = 1,
     .high = 50},
    {.name = "p_transition",
     .unit = "GPa",
     .type = FF_REAL,
     .doc = "pressure at which the two lines of ln(eta) meet",
     .flags = FF_REQUIRED | FF_MIN_OPEN,
     .max = 100,
     .low = 0.05,
     .high = 1},
    {.name = "transition_width",
     .unit = "GPa",
     .type = FF_REAL,
     .doc = "range of pressure around p_transition over which the slope changes; 0: it jumps",
     .preset = "0 GPa",
     .min = 0,
     .max = 100},
};

static ff_status create(const ff_host *host, void **self)
{
    return viscosity_law_create(host, sizeof(two_slope), 2.4e-3, eval, self);
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    two_slope *t = self;
    double *own[] = {&t->alpha_1, &t->alpha_2, &t->middle,
                     &t->width}; /* in the order of the rows */
    if (param < VISCOSITY_LAW_PARAMS)
        return viscosity_law_set(&t->law, param, value);
    *own[param - VISCOSITY_LAW_PARAMS] = value->real;
    return FF_OK;
}

static ff_status ready(void *self)
{
    two_slope *t = self;
    if (t->width > 2 * t->middle)
        return ff_failf(t->law.host, FF_INVALID, "transition_width",
                        "the transition would begin below ambient pressure: its width, %g GPa, "
                        "must not exceed twice p_transition, %g GPa",
                        1e-9 * t->width, 1e-9 * t->middle);
    return viscosity_law_ready(&t->law, viscosity_highest_cap);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "viscosity/two-slope",
    .version = "1.0.0",
    .summary = "Barus' law with another slope at high pressure",
    .reference = "Allen, Townsend & Zaretsky 1970, J. Lubrication Technology 92, 145-155; Goglia, "
                 "Cusano & Conry 1984, J. Tribology 106, 104-112",
    .bibtex =
        "@article{Allen1970, author={Allen, C. W. and Townsend, D. P. and Zaretsky, E. V.}, "
        "title={Elastohydrodynamic lubrication of a spinning ball in a nonconforming groove}, "
        "journal={Journal of Lubrication Technology}, volume={92}, year={1970}}\n"
        "@article{Goglia1984, author={Goglia, P. R. and Cusano, C. and Conry, T. F.}, title={The "
        "effects of surface irregularities on the elastohydrodynamic lubrication of sliding line "
        "contacts. {Part I}: single irregularities}, journal={Journal of Tribology}, "
        "volume={106}, pages={104--112}, year={1984}}",
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
