/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "roughness.h"

#include "fourier.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* Least squares by the polynomials that are orthogonal on the points, from their three-term
   recurrence (Forsythe 1957). */
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
        /* the middle term of the recurrence vanishes, since the points lie symmetrically */
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

/* Weights of the Gaussian filter (ISO 16610-21), exp(-pi (x/(alpha cutoff))^2), alpha = sqrt(ln
   2/pi), out to x = cutoff, where 1e-6 of the largest is left; their sum is 1, and they wrap around
   m points. */
static void set_weights(double cutoff, size_t reach, size_t m, double complex *weight)
{
    double sum = 0;
    for (size_t i = 0; i < m; i++)
        weight[i] = 0;
    for (size_t i = 0; i <= reach; i++) {
        double x = (double)i / cutoff, w = exp(-M_PI * M_PI / M_LN2 * x * x);
        weight[i] = w;
        weight[(m - i) % m] = w;
        sum += i ? 2 * w : w;
    }
    for (size_t i = 0; i < m; i++)
        weight[i] /= sum;
}

static ff_status low_pass(size_t n, double cutoff, const double *height, double *smooth)
{
    const size_t reach = (size_t)fmin(ceil(cutoff), (double)n);
    const size_t m = surface_power_of_two((double)(n + 2 * reach));
    double complex *z = calloc(m, sizeof *z), *weight = malloc(m * sizeof *weight);
    ff_status status = z && weight ? FF_OK : FF_NOMEM;
    if (status == FF_OK) {
        for (size_t i = 0; i < n; i++)
            z[reach + i] = height[i];
        for (size_t i = 0; i < reach; i++) {
            z[reach - 1 - i] = height[i];
            z[reach + n + i] = height[n - 1 - i];
        }
        set_weights(cutoff, reach, m, weight);
        status = surface_fourier(m, z, -1);
    }
    if (status == FF_OK)
        status = surface_fourier(m, weight, -1);
    for (size_t i = 0; i < m && status == FF_OK; i++)
        z[i] *= weight[i] / (double)m;
    if (status == FF_OK)
        status = surface_fourier(m, z, 1);
    for (size_t i = 0; i < n && status == FF_OK; i++)
        smooth[i] = creal(z[reach + i]);
    free(z);
    free(weight);
    return status;
}

static ff_status filter(size_t n, double cutoff, double *height, bool subtract)
{
    double *smooth = malloc(n * sizeof *smooth);
    ff_status status = smooth ? low_pass(n, cutoff, height, smooth) : FF_NOMEM;
    for (size_t i = 0; i < n && status == FF_OK; i++)
        height[i] = subtract ? height[i] - smooth[i] : smooth[i];
    free(smooth);
    return status;
}

ff_status surface_remove_longer(size_t n, double cutoff, double *height)
{
    return filter(n, cutoff, height, true);
}

ff_status surface_remove_shorter(size_t n, double cutoff, double *height)
{
    return filter(n, cutoff, height, false);
}
