/* SPDX-License-Identifier: MIT */
/* Service "flankfilm.density/1": mass density of a liquid. */
#ifndef FLANKFILM_DENSITY_H
#define FLANKFILM_DENSITY_H

#include "plugin.h"

#define FF_DENSITY_ID "flankfilm.density/1"

typedef struct ff_density {
    size_t size;
    const void *self;
    /*
     * n        number of points
     * p        gauge pressure, Pa, n; below 0 the law continues its tangent at 0
     * T        temperature, K, n; NULL: the reference temperature that the law was given for
     * rho      kg/m3, n;  drho_dp  kg/(m3 Pa), n, may be NULL;  drho_dT  kg/(m3 K), n, may be NULL
     *
     * rho > 0 and all results are finite for every finite argument. FF_OK, or FF_DOMAIN when a
     * point lies outside the law's range and was continued. Pure; any thread. Arrays never overlap.
     */
    ff_status (*eval)(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT);
} ff_density;

#endif
