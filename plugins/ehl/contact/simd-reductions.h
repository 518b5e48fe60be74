/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums and extremes with four numbers in one SIMD vector. Compilers must keep the order of
   additions, so for a plain loop they would add the numbers one by one. */
#ifndef EHL_SIMD_REDUCTIONS_H
#define EHL_SIMD_REDUCTIONS_H

#include <flankfilm/simd.h>

enum { EHL_LANES = 4 };
typedef double ehl_lanes __attribute__((vector_size(EHL_LANES * sizeof(double))));
typedef int64_t ehl_lanes_bits __attribute__((vector_size(EHL_LANES * sizeof(double))));

/* The vector is passed by pointer, since vectors passed by value have another ABI without AVX. */
FF_SIMD_INLINE double ehl_lanes_sum(const ehl_lanes *values)
{
    return (*values)[0] + (*values)[1] + ((*values)[2] + (*values)[3]);
}

/* Return the smaller and the larger of a and b; b if one of them is NaN. */
FF_SIMD_INLINE double ehl_lesser(double a, double b)
{
    return a < b ? a : b;
}

FF_SIMD_INLINE double ehl_greater(double a, double b)
{
    return a > b ? a : b;
}

FF_SIMD_INLINE double ehl_lanes_least(const ehl_lanes *x)
{
    double found = (*x)[EHL_LANES - 1];
    for (size_t k = 0; k + 1 < EHL_LANES; k++)
        found = ehl_lesser((*x)[k], found);
    return found;
}

FF_SIMD_INLINE double ehl_lanes_greatest(const ehl_lanes *x)
{
    double found = (*x)[EHL_LANES - 1];
    for (size_t k = 0; k + 1 < EHL_LANES; k++)
        found = ehl_greater((*x)[k], found);
    return found;
}

/* Keep the smaller and the larger of both in each lane; NaN is skipped. */
FF_SIMD_INLINE void ehl_lanes_keep_least(ehl_lanes *least, const ehl_lanes *x)
{
#pragma GCC unroll 1 /* if it unrolled the loop, gcc would process the lanes one by one */
    for (size_t k = 0; k < EHL_LANES; k++)
        (*least)[k] = ehl_lesser((*x)[k], (*least)[k]);
}

FF_SIMD_INLINE void ehl_lanes_keep_greatest(ehl_lanes *most, const ehl_lanes *x)
{
#pragma GCC unroll 1
    for (size_t k = 0; k < EHL_LANES; k++)
        (*most)[k] = ehl_greater((*x)[k], (*most)[k]);
}

double ehl_sum(size_t n, const double *x);
double ehl_dot(size_t n, const double *x, const double *y);

/* Returns the smallest of all x: infinite if there are none, NaN if the first is NaN. */
double ehl_least(size_t n, const double *x);

/* Return the largest of `least` and all x, or of `least` and all |x|. */
double ehl_greatest(size_t n, const double *x, double least);
double ehl_greatest_size(size_t n, const double *x);

/* Keeps the larger of both; NaN counts as larger than every number. */
void ehl_worse(double *worst, double value);

#endif
