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
FF_SIMD_INLINE double rheology_limited(double tau, double p, double coefficient)
{
    double most = coefficient * (p > 0 ? p : 0), cut = tau < most ? tau : most;
    return coefficient > 0 ? cut : tau;
}

/*
 * flankfilm.rheology/2. Stresses and viscosities within these bounds, rates up to RHEOLOGY_RATE_MAX
 * follow the law; beyond, a rate goes on as its tangent, which stays finite.
 */
static const double RHEOLOGY_TAU_MAX = 1e100;      /* Pa */
static const double RHEOLOGY_LN_ETA_MIN = -200;    /* of eta in Pa s */
static const double RHEOLOGY_RATE_MAX = 1e30;      /* 1/s */
static const double RHEOLOGY_STRESS_LEAST = 1e-30; /* Pa, of tau0 and G */

/* A coefficient of a limiting stress; `on` is 0 where there is none, 1 else. */
typedef struct rheology_limit {
    double on, coefficient;
} rheology_limit;

static inline rheology_limit rheology_limit_of(double coefficient)
{
    return coefficient > 0 ? (rheology_limit){1, coefficient} : (rheology_limit){0, 1};
}

/*
 * What the limiting stress adds to the rate: the film slips by 1e7 1/s, as much as films do, 1 %
 * above tau_L, and by the square of the excess. tau_L is coefficient p, but 4 MPa at least, that of
 * a PAO at ambient pressure: a film whose limit vanished with p would slip in the inlet.
 */
FF_SIMD_INLINE double rheology_slip(double size, double p, rheology_limit limiting, double *slope)
{
    const double least = 4e6, steep = 1e7 / (0.01 * 0.01), far = 1e9;
    double limit = limiting.coefficient * p;
    limit = limit > least ? limit : least;
    double excess = size / limit - 1;
    excess = excess > 0 ? excess : 0;
    double near = excess < far ? excess : far;
    *slope = limiting.on * 2 * steep * near / limit;
    return limiting.on * steep * near * (near + 2 * (excess - near));
}

/* Rates of n points and their derivatives; arrays never overlap. Returns whether any was held. */
typedef int64_t rheology_rate(const void *law, size_t n, const double *p, const double *ln_eta,
                              const double *tau, double *rate, double *by_tau, double *by_ln_eta);
/* The same, where derivatives may be NULL; FF_DOMAIN when any was held. */
ff_status rheology_rates(rheology_rate *curve, const void *law, size_t n, const double *p,
                         const double *ln_eta, const double *tau, double *rate, double *by_tau,
                         double *by_ln_eta);

/* psi of n points and its derivatives; arrays never overlap. Returns whether any was held. */
typedef int64_t rheology_curve(const void *law, size_t n, const double *ln_eta, const double *h,
                               double slip, double *psi, double *by_ln_eta, double *by_h);
/* The same, where derivatives may be NULL. */
int64_t rheology_points(rheology_curve *curve, const void *law, size_t n, const double *ln_eta,
                        const double *h, double slip, double *psi, double *by_ln_eta, double *by_h);

#endif
