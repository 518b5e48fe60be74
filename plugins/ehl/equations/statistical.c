/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistical.h"

#include <flankfilm/simd.h>

FF_SIMD
static void hold(double scale, double softness, size_t n, const double *restrict p,
                 double *restrict p_a, double *restrict slope, double *restrict fluid)
{
    for (size_t i = 0; i < n; i++) {
        double elastic = scale * p_a[i], part = 1 / (1 + elastic * softness);
        p_a[i] = elastic * part;
        slope[i] *= scale * part * part;
        fluid[i] = p[i] - p_a[i];
    }
}

ff_status ehl_statistical_pressure(const ehl_statistical *s, size_t n, const double *h,
                                   const double *p, double *p_a, double *slope, double *fluid)
{
    ff_status status = s->law->pressure(s->law->self, n, h, p_a, slope);
    hold(s->scale * s->share, s->hardness > 0 ? 1 / s->hardness : 0, n, p, p_a, slope, fluid);
    return status;
}
