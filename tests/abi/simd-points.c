/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loops of simd.c, built once for each of several processors. */
#include <flankfilm/simd.h>

void EXP_POINTS(size_t n, const double *restrict x, double *restrict y);
void LOG_POINTS(size_t n, const double *restrict x, double *restrict y);

FF_SIMD
void EXP_POINTS(size_t n, const double *restrict x, double *restrict y)
{
    for (size_t i = 0; i < n; i++)
        y[i] = ff_exp(x[i]);
}

FF_SIMD
void LOG_POINTS(size_t n, const double *restrict x, double *restrict y)
{
    for (size_t i = 0; i < n; i++)
        y[i] = ff_log(x[i]);
}
