/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Removes form, waviness and short waves from heights. */
#include "roughness.h"

#include "fourier.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* Fits by least squares with polynomials that are orthogonal on the points; a three-term recurrence
   gives these polynomials (Forsythe 1957). */
ff_status surface_detrend(size_t n, int order, double *height)
{
    double *memory = calloc(2 * n, sizeof *memory), *p = memory, *last = memory + n;
    if (!memory)
        return FF_NOMEM;
    double norm_last = 0;
    for (size_t i = 0; i < n; i++)
        p[i] = 1;
    for (int k = 0; k <= order; k++) {
        double norm = 0, product = 0;
        for (size_t i = 0; i < n; i++) {
            norm += p[i] * p[i];
            product += p[i] * height[i];
        }
        for (size_t i = 0; i < n; i++)
            height[i] -= product / norm * p[i];
        /* the recurrence has no middle term, since the points lie symmetrically */
        double b = k > 0 ? norm / norm_last : 0;
        for (size_t i = 0; i < n; i++) {
            double t = (2 * (double)i - (double)(n - 1)) / (double)(n > 1 ? n - 1 : 1);
            double next = t * p[i] - b * last[i];
            last[i] = p[i];
            p[i] = next;
        }
        norm_last = norm;
    }
    free(memory);
    return FF_OK;
}

/* Returns the share of a wave of `length` that the Gaussian filter passes: exp(-pi (alpha
   cutoff/length)^2), alpha = sqrt(ln 2/pi) (ISO 16610-21). It is one half for a wave as long as the
   cut-off. */
static double passed(double cutoff, double length)
{
    return exp2(-cutoff * cutoff / (length * length));
}

/* Returns the index inside a record of n points that corresponds to the index `place` beyond its
   ends. */
static size_t within(double place, size_t n, surface_end end)
{
    double turn = floor(place / (double)n);
    size_t i = (size_t)(place - turn * (double)n);
    return end == SURFACE_MIRRORED && fmod(turn, 2) != 0 ? n - 1 - i : i;
}

/* The filter's weight is below 1e-6 of its peak beyond the cut-off, and below 1e-24 beyond twice
 * the cut-off. */
static ff_status low_pass(size_t n, double cutoff, surface_end end, const double *height,
                          double *smooth)
{
    const bool whole = end == SURFACE_REPEATED && surface_power_of_two((double)n) == n;
    const double beyond = whole ? 0 : ceil(2 * cutoff);
    const size_t m = surface_power_of_two((double)n + 2 * beyond), first = (size_t)beyond;
    double complex *z = malloc(m * sizeof *z);
    if (!z)
        return FF_NOMEM;
    for (size_t i = 0; i < m; i++)
        z[i] = height[within((double)i - beyond, n, end)];
    ff_status status = surface_fourier(m, z, -1);
    for (size_t k = 0; k < m && status == FF_OK; k++)
        z[k] *= passed(cutoff, (double)m / (double)(k < m - k ? k : m - k)) / (double)m;
    if (status == FF_OK)
        status = surface_fourier(m, z, 1);
    for (size_t i = 0; i < n && status == FF_OK; i++)
        smooth[i] = creal(z[first + i]);
    free(z);
    return status;
}

static ff_status filter(size_t n, double cutoff, surface_end end, double *height, bool subtract)
{
    double *smooth = malloc(n * sizeof *smooth);
    ff_status status = smooth ? low_pass(n, cutoff, end, height, smooth) : FF_NOMEM;
    for (size_t i = 0; i < n && status == FF_OK; i++)
        height[i] = subtract ? height[i] - smooth[i] : smooth[i];
    free(smooth);
    return status;
}

ff_status surface_remove_longer(size_t n, double cutoff, double *height)
{
    return filter(n, cutoff, SURFACE_MIRRORED, height, true);
}

ff_status surface_remove_shorter(size_t n, double cutoff, surface_end end, double *height)
{
    return filter(n, cutoff, end, height, false);
}
