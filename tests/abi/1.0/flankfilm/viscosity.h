/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.viscosity/1": dynamic viscosity of a liquid.
 *
 * The law answers with ln(eta / 1 Pa s), which neither overflows nor underflows where eta does.
 */
#ifndef FLANKFILM_VISCOSITY_H
#define FLANKFILM_VISCOSITY_H

#include "plugin.h"

#define FF_VISCOSITY_ID "flankfilm.viscosity/1"

typedef struct ff_viscosity {
    size_t size;
    const void *self;
    /*
     * n        number of points
     * p        gauge pressure, Pa, n; below 0 the law continues its tangent at 0
     * T        temperature, K, n; NULL: the reference temperature that the law was given for
     * ln_eta   n;  dln_dp  1/Pa, n, may be NULL;  dln_dT  1/K, n, may be NULL
     *
     * All results are finite for every finite argument. FF_OK, or FF_DOMAIN when a point lies
     * outside the law's range and was continued. Pure; any thread. Arrays never overlap.
     */
    ff_status (*eval)(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT);
} ff_viscosity;

#endif
