/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sobol sequence with the direction numbers of Joe & Kuo 2008, SIAM J. Sci. Comput. 30, 2635. */
#include "study.h"

enum { BITS = 32, LONGEST = 6 };

/* A primitive polynomial with its degree, its inner coefficients as bits, and the first m_k. */
static const struct {
    uint8_t degree, inner, m[LONGEST];
} polynomials[STUDY_SOBOL_DIMENSIONS - 1] = {
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
};

/* Sets the direction numbers v_k = m_k 2^(32-k) by the recurrence of the polynomial. */
static void directions(uint32_t dimension, uint32_t v[BITS])
{
    uint32_t degree = dimension ? polynomials[dimension - 1].degree : BITS;
    for (uint32_t k = 0; k < BITS; k++) {
        uint32_t m = dimension && k < degree ? polynomials[dimension - 1].m[k] : 1;
        v[k] = m << (BITS - 1 - k);
        if (k < degree)
            continue;
        v[k] = v[k - degree] ^ (v[k - degree] >> degree);
        for (uint32_t i = 1; i < degree; i++)
            if (polynomials[dimension - 1].inner >> (degree - 1 - i) & 1)
                v[k] ^= v[k - i];
    }
}

/* splitmix64 (Steele, Lea & Flood 2014). */
static uint64_t scramble(uint64_t x)
{
    x += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    return x ^ (x >> 31);
}

double study_sobol(uint32_t index, uint32_t dimension, uint64_t seed)
{
    uint32_t v[BITS], gray = index ^ (index >> 1), x = 0;
    directions(dimension, v);
    for (uint32_t k = 0; k < BITS; k++)
        if (gray >> k & 1)
            x ^= v[k];
    if (seed) /* a digital shift, which keeps the points evenly distributed */
        x ^= (uint32_t)(scramble(scramble(seed) + dimension) >> 32);
    return (double)x / 4294967296.0;
}
