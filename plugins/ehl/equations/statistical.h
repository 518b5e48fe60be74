/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Flanks with asperities given by their statistics. The asperities carry the mean pressure p_a(h),
 * where h is the distance between the mean planes (flankfilm.asperity/1). The oil carries the rest
 * of the pressure p:
 *   p = p_f + p_a(h),
 * p is used in the balance of load and in the deflection, p_f in Reynolds' equation and in the laws
 * of the oil. The unknown is p. If the summits yield, their pressure is limited by the hardness H:
 * p_a H/(p_a + H) replaces p_a.
 */
#ifndef EHL_STATISTICAL_H
#define EHL_STATISTICAL_H

#include <flankfilm/laws.h>

typedef struct ehl_statistical {
    const ff_asperity *law; /* NULL: no statistical asperities */
    double scale;           /* factor on p_a: E' of the contact over E' of the law */
    double share;           /* share of p_a that is applied; below 1 only during a continuation */
    double hardness;        /* Pa; 0: elastic */
} ehl_statistical;

/* Computes p_a and its derivative with respect to h at n nodes, and fluid = p - p_a. */
ff_status ehl_statistical_pressure(const ehl_statistical *s, size_t n, const double *h,
                                   const double *p, double *p_a, double *slope, double *fluid);

#endif
