/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fourier.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

size_t surface_power_of_two(double least)
{
    assert(least <= 0x1p52);
    size_t n = 1;
    while ((double)n < least && n < (size_t)1 << 52)
        n *= 2;
    return n;
}

/* Permutes x by reversing the bits of the index. */
static void reverse_bits(size_t n, double complex *x)
{
    for (size_t i = 1, j = 0; i < n; i++) {
        size_t bit = n / 2;
        for (; j & bit; bit /= 2)
            j ^= bit;
        j ^= bit;
        if (i < j) {
            double complex t = x[i];
            x[i] = x[j];
            x[j] = t;
        }
    }
}

/* Cooley and Tukey 1965, radix 2. */
ff_status surface_fourier(size_t n, double complex *x, double sign)
{
    assert(n > 0 && (n & (n - 1)) == 0);
    double complex *root = malloc((n / 2 + 1) * sizeof *root);
    if (!root)
        return FF_NOMEM;
    for (size_t k = 0; k < n / 2; k++) {
        double angle = 2 * M_PI * (double)k / (double)n;
        root[k] = cexp(sign * angle * I);
    }
    reverse_bits(n, x);
    for (size_t half = 1; half < n; half *= 2)
        for (size_t first = 0; first < n; first += 2 * half)
            for (size_t k = 0; k < half; k++) {
                double complex *a = &x[first + k], *b = a + half;
                double complex t = *b * root[k * (n / (2 * half))];
                *b = *a - t;
                *a += t;
            }
    free(root);
    return FF_OK;
}
