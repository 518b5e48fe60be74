/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the rheology laws share: the limiting shear stress, and bounds that keep the laws finite,
 * far outside anything physical.
 */
#ifndef RHEOLOGY_LAW_H
#define RHEOLOGY_LAW_H

#include <flankfilm/author.h>
#include <flankfilm/laws.h>
#include <flankfilm/simd.h>

#include <math.h>

/* The last row of every law's parameters: a member of its instance, NaN: no limit. */
#define RHEOLOGY_LIMITING_STRESS_ROW(type)                                                         \
    FF_QUANTITY("limiting_stress_coefficient", "1", type, limiting_stress_coefficient,             \
                FF_MIN_OPEN, NULL, NULL, 0, 10, 0.01, 0.15,                                        \
                "the shear stress stays below this times the pressure; not given: no limit")

/* Literature of the limiting shear stress. */
#define RHEOLOGY_LIMITING_STRESS_REFERENCE                                                         \
    "limiting stress: Bair & Winer 1979, J. Lubrication Technology 101, 258-264"

enum { RHEOLOGY_LN_MAX = 690 };                /* e^690 = 1e299.7 */
static const double RHEOLOGY_FILM_MIN = 1e-30; /* m */

/* Fluidity 1/eta, held between e^-690 and e^690 1/(Pa s). */
FF_SIMD_INLINE double rheology_fluidity(double ln_eta)
{
    double x = ln_eta > -RHEOLOGY_LN_MAX ? ln_eta : -RHEOLOGY_LN_MAX;
    return ff_exp(-(x < RHEOLOGY_LN_MAX ? x : RHEOLOGY_LN_MAX));
}

/* Film thickness, held above RHEOLOGY_FILM_MIN. */
FF_SIMD_INLINE double rheology_film(double h)
{
    return h > RHEOLOGY_FILM_MIN ? h : RHEOLOGY_FILM_MIN;
}

/* The limiting shear stress of Bair & Winer 1979, tau_L = coefficient p, cuts the stress off. */
static inline double rheology_limited(double tau, double p, double coefficient)
{
    return coefficient > 0 ? fmin(tau, coefficient * fmax(p, 0)) : tau;
}

/* psi of n points and its derivatives; arrays never overlap. Returns whether any was held. */
typedef int64_t rheology_curve(const void *law, size_t n, const double *ln_eta, const double *h,
                               double slip, double *psi, double *by_ln_eta, double *by_h);
/* The same, where derivatives may be NULL. */
int64_t rheology_points(rheology_curve *curve, const void *law, size_t n, const double *ln_eta,
                        const double *h, double slip, double *psi, double *by_ln_eta, double *by_h);

#endif
