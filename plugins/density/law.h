/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the density laws: rho0, or a liquid that gives it as a function of temperature. */
#ifndef DENSITY_LAW_H
#define DENSITY_LAW_H

#include <flankfilm/author.h>
#include <flankfilm/laws.h>
#include <flankfilm/simd.h>

/* First members of every law's instance. */
typedef struct density_law {
    const ff_host *host;
    ff_density service;
    double rho0;             /* kg/m3; 1 if a liquid is wired */
    const ff_liquid *liquid; /* NULL: not wired */
} density_law;

/*
 * Softening of a law with temperature; its constants hold at the temperature `at`, K. ln(K0)
 * decreases by `decay` per kelvin, 1/K, and the thermal expansion of the oil decreases under
 * pressure as (rho/rho0)^-n, n = decay/expansion: (6.26), Anderson 1967.
 */
typedef struct density_softening {
    double decay, at;
} density_softening;

#define DENSITY_SOFTENING_ROWS(type, member)                                                       \
    FF_QUANTITY(                                                                                   \
        "K0_decay", "1/K", type, member.decay, 0, "0 1/K", NULL, 0, 0.05, 0, 0.009,                \
        "decrease of the logarithm of the bulk modulus per kelvin above the temperature `at`"),    \
        FF_QUANTITY_OR("auto", "at", "degC", type, member.at, 0, "auto", NULL, -150, 500, -20,     \
                       150,                                                                        \
                       "temperature for which the constants of the law are given; auto: they "     \
                       "hold at every temperature; required with K0_decay")
/* Refuses a decay without `at`. Replaces an unset `at` by a number, and sets the decay to 0 if no
   oil is wired. */
ff_status density_softening_ready(const void *law, density_softening *softening);

#define DENSITY_RHO0_ROW(type, doc)                                                                \
    FF_QUANTITY_UNLESS("oil", "rho0", "kg/m3", type, rho0, FF_REQUIRED, NULL, NULL, 1, 1e5, 600,   \
                       2000, doc)

/* The only input of every law, and its `wire` function. */
extern const ff_port density_inputs[1];
ff_status density_wire(void *self, uint32_t input, const void *service);

/* The density of the liquid at ambient pressure for the points of one eval. */
typedef struct density_ambient {
    double rho0, slope; /* kg/m3, and its slope over T; 1 and 0 if T differs between points */
    int varies;         /* T differs between points; density_end then multiplies by rho0 */
    ff_status status;
} density_ambient;

density_ambient density_begin(const void *law, size_t n, const double *T);

/* Evaluates rho and its slope over p at n points with one rho0, for p >= 0; for p < 0 the results
   may be any finite numbers. The arrays do not overlap. */
typedef void density_curve(const void *law, double rho0, size_t n, const double *p, double *rho,
                           double *drho_dp);
/* A law whose tangent at ambient pressure is 1 + p/K0, valid up to the pressure `highest`. */
typedef struct density_shape {
    density_curve *curve;
    double K0, highest; /* Pa */
    density_softening softening;
} density_shape;

ff_status density_eval(const void *law, const density_shape *shape, size_t n, const double *p,
                       const double *T, double *rho, double *drho_dp, double *drho_dT);

/* Ends an eval of a law whose rho/rho0 does not depend on temperature: multiplies by the liquid's
   density if it varies between points, and fills in drho_dT. Derivatives may be NULL. `status` is
   that of the law. */
ff_status density_end(const density_law *law, const density_ambient *ambient, ff_status status,
                      size_t n, const double *T, double *rho, double *drho_dp, double *drho_dT);

#endif
