/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bounds that keep the rheology laws finite, far outside anything physical. */
#ifndef RHEOLOGY_FILM_H
#define RHEOLOGY_FILM_H

#include <math.h>

enum { RHEOLOGY_LN_MAX = 690 };                /* e^690 = 1e299.7 */
static const double RHEOLOGY_FILM_MIN = 1e-30; /* m */

/* Fluidity 1/eta, held between e^-690 and e^690 1/(Pa s). */
static inline double rheology_fluidity(double ln_eta)
{
    double x = ln_eta > -RHEOLOGY_LN_MAX ? ln_eta : -RHEOLOGY_LN_MAX;
    return exp(-(x < RHEOLOGY_LN_MAX ? x : RHEOLOGY_LN_MAX));
}

static inline double rheology_film(double h)
{
    return h > RHEOLOGY_FILM_MIN ? h : RHEOLOGY_FILM_MIN;
}

/* The limiting shear stress of Bair & Winer 1979, tau_L = coefficient p, cuts the stress off;
   a coefficient of 0 means no limit. */
static inline double rheology_limited(double tau, double p, double coefficient)
{
    return coefficient > 0 ? fmin(tau, coefficient * fmax(p, 0)) : tau;
}

#endif
