/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the interval of a sorted array that contains a value. */
#ifndef NUMERICS_INTERVAL_H
#define NUMERICS_INTERVAL_H

#include <assert.h>
#include <stddef.h>

/* Returns the index of the last of n >= 2 non-decreasing values that is <= at, from 0 to n - 2. */
static inline size_t numerics_interval(size_t n, const double *x, double at)
{
    assert(n >= 2);
    size_t low = 0, high = n - 1;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (x[middle] <= at)
            low = middle;
        else
            high = middle;
    }
    return low;
}

#endif
