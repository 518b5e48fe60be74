/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Four numbers at a time, in one vector. */
#ifndef EHL_LANES_H
#define EHL_LANES_H

#include <flankfilm/simd.h>

enum { EHL_LANES = 4 };
typedef double ehl_lanes __attribute__((vector_size(EHL_LANES * sizeof(double))));

/* By a pointer: a vector that is passed by value has another ABI without AVX. */
FF_SIMD_INLINE double ehl_lanes_sum(const ehl_lanes *values)
{
    return (*values)[0] + (*values)[1] + ((*values)[2] + (*values)[3]);
}

/* Keeps the lesser of both in each lane; what is no number is passed over. */
FF_SIMD_INLINE void ehl_lanes_keep_least(ehl_lanes *least, const ehl_lanes *x)
{
    typedef int64_t mask __attribute__((vector_size(sizeof *x)));
    mask less = *x < *least;
    *least = (ehl_lanes)((less & (mask)*x) | (~less & (mask)*least));
}

#endif
