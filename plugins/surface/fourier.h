/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Discrete Fourier transform. */
#ifndef SURFACE_FOURIER_H
#define SURFACE_FOURIER_H

#include <flankfilm/plugin.h>

#include <complex.h>

/* Replaces x_j by the sum over k of x_k exp(sign 2 pi i j k/n); n is a power of 2, sign +1 or -1.
 */
ff_status surface_fourier(size_t n, double complex *x, double sign);

/* Returns the smallest power of 2 >= `least`, which must be at most 2^52. */
size_t surface_power_of_two(double least);

#endif
