/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "simd-reductions.h"

#include <math.h>

FF_SIMD
double ehl_sum(size_t n, const double *restrict x)
{
    ehl_lanes sum = {0}, here;
    size_t i = 0;
    for (; i + EHL_LANES <= n; i += EHL_LANES) {
        memcpy(&here, x + i, sizeof here);
        sum += here;
    }
    for (; i < n; i++)
        sum[0] += x[i];
    return ehl_lanes_sum(&sum);
}

FF_SIMD
double ehl_dot(size_t n, const double *restrict x, const double *restrict y)
{
    ehl_lanes sum = {0}, of_x, of_y;
    size_t i = 0;
    for (; i + EHL_LANES <= n; i += EHL_LANES) {
        memcpy(&of_x, x + i, sizeof of_x);
        memcpy(&of_y, y + i, sizeof of_y);
        sum += of_x * of_y;
    }
    for (; i < n; i++)
        sum[0] += x[i] * y[i];
    return ehl_lanes_sum(&sum);
}

FF_SIMD
double ehl_least(size_t n, const double *restrict x)
{
    const double first = n > 0 ? x[0] : HUGE_VAL;
    ehl_lanes least = {first, first, first, first}, here;
    size_t i = 0;
    for (; i + EHL_LANES <= n; i += EHL_LANES) {
        memcpy(&here, x + i, sizeof here);
        ehl_lanes_keep_least(&least, &here);
    }
    double lowest = ehl_lanes_least(&least);
    for (; i < n; i++)
        lowest = ehl_lesser(x[i], lowest);
    return lowest;
}

FF_SIMD
double ehl_greatest(size_t n, const double *restrict x, double least)
{
    ehl_lanes most = {least, least, least, least}, here;
    size_t i = 0;
    for (; i + EHL_LANES <= n; i += EHL_LANES) {
        memcpy(&here, x + i, sizeof here);
        ehl_lanes_keep_greatest(&most, &here);
    }
    double highest = ehl_lanes_greatest(&most);
    for (; i < n; i++)
        highest = ehl_greater(x[i], highest);
    return highest;
}

FF_SIMD
double ehl_greatest_size(size_t n, const double *restrict x)
{
    ehl_lanes most = {0, 0, 0, 0}, here;
    size_t i = 0;
    for (; i + EHL_LANES <= n; i += EHL_LANES) {
        memcpy(&here, x + i, sizeof here);
        here = (ehl_lanes)((ehl_lanes_bits)here & INT64_MAX); /* clears the sign bit */
        ehl_lanes_keep_greatest(&most, &here);
    }
    double highest = ehl_lanes_greatest(&most);
    for (; i < n; i++)
        highest = ehl_greater(fabs(x[i]), highest);
    return highest;
}

void ehl_worse(double *worst, double value)
{
    if (!(value <= *worst))
        *worst = isfinite(value) ? value : 1e300;
}
