/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the density laws share: rho0 and the frame of a model. */
#ifndef DENSITY_LAW_H
#define DENSITY_LAW_H

#include <flankfilm/author.h>
#include <flankfilm/density.h>

/* First member of every law's instance. */
typedef struct density_law {
    ff_density service;
    double cost; /* s for a million points */
    double rho0; /* kg/m3 */
} density_law;

/* Row 0 of every law's parameters. */
#define DENSITY_RHO0_ROW(text)                                                                     \
    {                                                                                              \
        .name = "rho0", .unit = "kg/m3", .doc = text, .type = FF_REAL, .flags = FF_REQUIRED,       \
        .min = 1, .max = 1e5, .low = 600, .high = 2000                                             \
    }

/* The one output of every law: row 0, the service. */
extern const ff_port density_law_outputs[1];

/* The function of ff_density. */
typedef ff_status density_eval(const void *self, size_t n, const double *p, const double *T,
                               double *rho, double *drho_dp, double *drho_dT);

/* `size`: of the instance, which begins with a density_law and is zeroed; `cost` as above. */
ff_status density_law_create(size_t size, double cost, density_eval *eval, void **self);
const void *density_law_service(void *self, uint32_t output);
ff_status density_law_assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                             ff_assessment *assessment);

#endif
