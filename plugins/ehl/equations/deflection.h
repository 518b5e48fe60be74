/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Elastic deflection of two half-planes under line pressure,
 *   v(x) = -4/(pi E') int p(x') ln(|x - x'|/unit) dx',
 * with the pressure constant over a cell around each node (Johnson 1985, Contact Mechanics, 2.3).
 */
#ifndef EHL_DEFLECTION_H
#define EHL_DEFLECTION_H

#include <stddef.h>

/* Fills d[0 .. count-1] with the deflection at distance k dx per pressure in one cell, m/Pa. */
void ehl_kernel_fill(size_t count, double dx, double modulus, double unit, double *d);

/* Computes v[0 .. nodes-1] from p by the plain double sum. */
void ehl_kernel_direct(size_t nodes, const double *d, const double *p, double *v);

/* Adds to v what the pressure p of node k alone deflects. */
void ehl_deflect_by(size_t nodes, size_t k, double p, const double *d, double *v);

/* Computes this deflection as a circular convolution of length 2 (nodes - 1), which suffices
   because the pressure is zero at both ends. ehl_fft_create returns NULL if out of memory. */
typedef struct ehl_fft ehl_fft;
ehl_fft *ehl_fft_create(size_t nodes, const double *d);
void ehl_fft_apply(ehl_fft *f, const double *p, double *v);
void ehl_fft_destroy(ehl_fft *f);

#endif
