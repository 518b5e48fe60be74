/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the rheology laws share: the limiting shear stress, the frame of a model, and bounds that
 * keep the laws finite, far outside anything physical.
 */
#ifndef RHEOLOGY_LAW_H
#define RHEOLOGY_LAW_H

#include <flankfilm/author.h>
#include <flankfilm/rheology.h>

#include <math.h>

/* First member of every law's instance. */
typedef struct rheology_law {
    ff_rheology service;
    double cost;                        /* s for a million points */
    double limiting_stress_coefficient; /* 0: no limit */
} rheology_law;

/* The last row of every law's parameters. */
#define RHEOLOGY_LIMITING_STRESS_ROW                                                               \
    {                                                                                              \
        .name = "limiting_stress_coefficient", .unit = "1",                                        \
        .doc = "the shear stress stays below this times the pressure; not given: no limit",        \
        .type = FF_REAL, .flags = FF_MIN_OPEN, .max = 10, .low = 0.01, .high = 0.15                \
    }

/* Literature of the limiting shear stress. */
#define RHEOLOGY_LIMITING_STRESS_REFERENCE                                                         \
    "limiting stress: Bair & Winer 1979, J. Lubrication Technology 101, 258-264"
#define RHEOLOGY_LIMITING_STRESS_BIBTEX                                                            \
    "@article{BairWiner1979, author={Bair, S. and Winer, W. O.}, title={A rheological "            \
    "model for elastohydrodynamic contacts based on primary laboratory data}, "                    \
    "journal={Journal of Lubrication Technology}, volume={101}, pages={258--264}, "                \
    "year={1979}}"

/* The one output of every law: row 0, the service. */
extern const ff_port rheology_law_outputs[1];

/* The functions of ff_rheology. */
typedef ff_status rheology_flow(const void *self, size_t n, const double *ln_eta, const double *h,
                                double u_s, double *psi, double *dpsi_dln_eta, double *dpsi_dh);
typedef ff_status rheology_shear(const void *self, size_t n, const double *p, const double *ln_eta,
                                 const double *h, double u_s, double *tau);

/* `size`: of the instance, which begins with a rheology_law and is zeroed; `cost` as above. */
ff_status rheology_law_create(size_t size, double cost, rheology_flow *flow, rheology_shear *shear,
                              void **self);
const void *rheology_law_service(void *self, uint32_t output);
ff_status rheology_law_assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                              ff_assessment *assessment);

enum { RHEOLOGY_LN_MAX = 690 };                /* e^690 = 1e299.7 */
static const double RHEOLOGY_FILM_MIN = 1e-30; /* m */

/* Fluidity 1/eta, held between e^-690 and e^690 1/(Pa s). */
static inline double rheology_fluidity(double ln_eta)
{
    double x = ln_eta > -RHEOLOGY_LN_MAX ? ln_eta : -RHEOLOGY_LN_MAX;
    return exp(-(x < RHEOLOGY_LN_MAX ? x : RHEOLOGY_LN_MAX));
}

/* Film thickness, held above RHEOLOGY_FILM_MIN. */
static inline double rheology_film(double h)
{
    return h > RHEOLOGY_FILM_MIN ? h : RHEOLOGY_FILM_MIN;
}

/* The limiting shear stress of Bair & Winer 1979, tau_L = coefficient p, cuts the stress off. */
static inline double rheology_limited(double tau, double p, double coefficient)
{
    return coefficient > 0 ? fmin(tau, coefficient * fmax(p, 0)) : tau;
}

#endif
