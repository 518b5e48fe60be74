/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Doolittle free volume with the Tait equation of state (Li & Kahraman 2011, eqs 11a, 11b):
 *   V = 1 - ln(1 + p (1 + K0')/K0) / (1 + K0')
 *   ln(eta/eta0) = B V_occ (1 - V) / [(V - V_occ) (1 - V_occ)]
 * It has a pole where V falls to the occupied volume V_occ; the cap stays away from it.
 */
#include "law.h"

#include <math.h>

typedef struct doolittle_tait {
    viscosity_law law;
    double B, V_occ, K0, K0_prime;
} doolittle_tait;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const doolittle_tait *d = self;
    const double B = d->B, V_occ = d->V_occ, K0 = d->K0, k = 1 + d->K0_prime;
    const double cap = d->law.pressure_cap;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        double q = viscosity_law_clip(p[i], cap);
        double shrinkage = log(1 + q * k / K0) / k; /* 1 - V */
        double free = 1 - shrinkage - V_occ;        /* V - V_occ */
        double scale = B * V_occ / free;
        double slope = scale / free / (K0 + q * k);
        ln_eta[i] = d->law.ln_eta0 + scale * shrinkage / (1 - V_occ) + slope * (p[i] - q);
        if (dln_dp)
            dln_dp[i] = slope;
    }
    return viscosity_law_end(&d->law, n, p, dln_dT);
}

static const ff_param params[] = {
    VISCOSITY_LAW_ROWS,
    {.name = "B",
     .unit = "1",
     .type = FF_REAL,
     .doc = "Doolittle's constant",
     .flags = FF_REQUIRED,
     .max = 100,
     .low = 1,
     .high = 10},
    {.name = "V_occ",
     .unit = "1",
     .type = FF_REAL,
     .doc = "occupied volume over the volume at ambient pressure",
     .flags = FF_REQUIRED,
     .min = 0.05,
     .max = 0.95,
     .low = 0.5,
     .high = 0.8},
    {.name = "K0",
     .unit = "GPa",
     .type = FF_REAL,
     .doc = "bulk modulus at ambient pressure",
     .flags = FF_REQUIRED,
     .min = 0.01,
     .max = 1000,
     .low = 0.5,
     .high = 3},
    {.name = "K0_prime",
     .unit = "1",
     .type = FF_REAL,
     .doc = "rise of the bulk modulus with pressure",
     .flags = FF_REQUIRED,
     .max = 100,
     .low = 8,
     .high = 13},
};

static ff_status create(const ff_host *host, void **self)
{
    return viscosity_law_create(host, sizeof(doolittle_tait), 8e-3, eval, self);
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    doolittle_tait *d = self;
    double *own[] = {&d->B, &d->V_occ, &d->K0, &d->K0_prime}; /* in the order of the rows */
    if (param < VISCOSITY_LAW_PARAMS)
        return viscosity_law_set(&d->law, param, value);
    *own[param - VISCOSITY_LAW_PARAMS] = value->real;
    return FF_OK;
}

static ff_status ready(void *self)
{
    doolittle_tait *d = self;
    double k = 1 + d->K0_prime;
    double pole = d->K0 * expm1((1 - d->V_occ) * k) / k; /* V = V_occ */
    ff_status status = viscosity_law_ready(&d->law, fmin(viscosity_highest_cap, pole / 2));
    if (status == FF_OK && d->law.pressure_cap > 0.9 * pole)
        return ff_failf(d->law.host, FF_INVALID, "pressure_cap",
                        "the free volume ends at %g GPa; the cap must be below 0.9 of that",
                        1e-9 * pole);
    return status;
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "viscosity/doolittle-tait",
    .version = "1.0.0",
    .summary = "free-volume law: steep at ambient pressure, flatter, then steep again",
    .reference =
        "Doolittle 1951, J. Appl. Phys. 22, 1471-1475; Li & Kahraman 2011, Proc. IMechE J, 740-753",
    .bibtex =
        "@article{Doolittle1951, author={Doolittle, A. K.}, title={Studies in Newtonian flow. "
        "{II}. The dependence of the viscosity of liquids on free-space}, "
        "journal={Journal of Applied Physics}, volume={22}, pages={1471--1475}, "
        "year={1951}}\n"
        "@article{LiKahraman2011, author={Li, S. and Kahraman, A.}, title={Influence of "
        "dynamic behaviour on elastohydrodynamic lubrication of spur gears}, "
        "journal={Proceedings of the Institution of Mechanical Engineers, Part J}, "
        "pages={740--753}, year={2011}}",
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
