/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The services of include/flankfilm as arrays in, arrays out; and the plainest law of each. */
#include "subject.h"

#include <flankfilm/density.h>
#include <flankfilm/rheology.h>
#include <flankfilm/viscosity.h>

#include <math.h>
#include <string.h>

static const double any_pressure[] = {-1e30, -1e10, -1e6, 0, 1e6, 1e9, 1e10, 1e12, 1e30};
static const double any_temperature[] = {-1e30, 0, 1, 300, 1000, 1e30};
static const double any_ln_eta[] = {-1e4, -700, -5, 0, 30, 700, 1e4};
static const double any_film[] = {1e-300, 1e-15, 1e-9, 1e-6, 1, 1e30};

#define EXTREMES(list) (list), sizeof(list) / sizeof *(list)
#define PRESSURE                                                                                   \
    {                                                                                              \
        "p", 1e5, 3e9, true, false, EXTREMES(any_pressure)                                         \
    }
#define TEMPERATURE                                                                                \
    {                                                                                              \
        "T", 280, 420, false, true, EXTREMES(any_temperature)                                      \
    }
#define LN_ETA                                                                                     \
    {                                                                                              \
        "ln_eta", -7, 20, false, false, EXTREMES(any_ln_eta)                                       \
    }
#define FILM                                                                                       \
    {                                                                                              \
        "h", 1e-8, 1e-4, true, false, EXTREMES(any_film)                                           \
    }

static ff_status viscosity(const void *table, size_t n, const double *const *in, double speed,
                           double *const *out)
{
    const ff_viscosity *law = table;
    (void)speed;
    return law->eval(law->self, n, in[0], in[1], out[0], out[1], out[2]);
}

static ff_status density(const void *table, size_t n, const double *const *in, double speed,
                         double *const *out)
{
    const ff_density *law = table;
    (void)speed;
    return law->eval(law->self, n, in[0], in[1], out[0], out[1], out[2]);
}

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

const ff_kernel ff_kernels[] = {
    {.service = FF_VISCOSITY_ID,
     .name = "eval",
     .axes = {PRESSURE, TEMPERATURE},
     .axis_count = 2,
     .results = {"ln_eta", "dln_dp", "dln_dT"},
     .by = {0, 0, 1},
     .result_count = 3,
     .speed_count = 1,
     .rising = true,
     .call = viscosity},
    {.service = FF_DENSITY_ID,
     .name = "eval",
     .axes = {PRESSURE, TEMPERATURE},
     .axis_count = 2,
     .results = {"rho", "drho_dp", "drho_dT"},
     .by = {0, 0, 1},
     .result_count = 3,
     .speed_count = 1,
     .positive = true,
     .rising = true,
     .call = density},
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
const size_t ff_kernel_count = sizeof ff_kernels / sizeof ff_kernels[0];

/* The first result constant, its derivatives 0. */
static ff_status plain(const void *self, size_t n, const double *p, const double *T, double *value,
                       double *by_p, double *by_T)
{
    (void)p, (void)T;
    for (size_t i = 0; i < n; i++) {
        value[i] = *(const double *)self;
        if (by_p)
            by_p[i] = 0;
        if (by_T)
            by_T[i] = 0;
    }
    return FF_OK;
}

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

const void *ff_plain_service(const char *id)
{
    static const double ln_eta = -4, rho = 900;
    static const ff_viscosity oil = {sizeof oil, &ln_eta, plain};
    static const ff_density liquid = {sizeof liquid, &rho, plain};
    static const ff_rheology newtonian = {sizeof newtonian, NULL, plain_flow, plain_shear};
    if (!strcmp(id, FF_VISCOSITY_ID))
        return &oil;
    if (!strcmp(id, FF_DENSITY_ID))
        return &liquid;
    return strcmp(id, FF_RHEOLOGY_ID) ? NULL : &newtonian;
}
