/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "deflection.h"

#include "../../numerics/room.h"

#include <assert.h>
#include <flankfilm/simd.h>

#include <fftw3.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Returns the antiderivative of ln|s|, which is 0 at s = 0. */
static double log_integral(double s)
{
    return s > 0 ? s * log(s) - s : s < 0 ? s * log(-s) - s : 0;
}

void ehl_kernel_fill(size_t count, double dx, double modulus, double unit, double *d)
{
    assert(dx > 0 && modulus > 0);
    double scale = -4 / (acos(-1) * modulus);
    for (size_t k = 0; k < count; k++) {
        double s = (double)k, ln;
        if (k < 1000)
            ln = log_integral(s + 0.5) - log_integral(s - 0.5);
        else /* expansion of the integral, since its difference would suffer from cancellation */
            ln = log(s) - 1 / (24 * s * s) - 1 / (320 * s * s * s * s);
        d[k] = scale * dx * (ln + log(dx / unit));
    }
}

void ehl_kernel_direct(size_t nodes, const double *d, const double *p, double *v)
{
    for (size_t i = 0; i < nodes; i++) {
        double sum = 0;
        for (size_t j = 0; j < nodes; j++)
            sum += d[i > j ? i - j : j - i] * p[j];
        v[i] = sum;
    }
}

FF_SIMD
void ehl_deflect_by(size_t nodes, size_t k, double p, const double *restrict d, double *restrict v)
{
    for (size_t i = k; i < nodes; i++)
        v[i] += p * d[i - k];
    for (size_t i = 0; i < k; i++)
        v[i] += p * d[k - i];
}

struct ehl_fft {
    size_t nodes, length;
    fftw_plan forward, backward;
    double *line, *spectrum; /* spectrum of the kernel: real, because the kernel is even */
    double *bent;            /* output of the inverse transform; `line` is not used for it, since
                                the zeros at its end are kept */
    fftw_complex *image;
};

ehl_fft *ehl_fft_create(size_t nodes, const double *d)
{
    assert(nodes >= 2);
    ehl_fft *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    size_t last = nodes - 1, half = last + 1; /* length/2 + 1 */
    f->nodes = nodes;
    f->length = 2 * last;
    f->line = numerics_fftw_array(f->length, sizeof *f->line);
    f->bent = numerics_fftw_array(f->length, sizeof *f->bent);
    f->spectrum = numerics_fftw_array(half, sizeof *f->spectrum);
    f->image = numerics_fftw_array(half, sizeof *f->image);
    if (f->line && f->bent && f->spectrum && f->image &&
        numerics_has_room(numerics_fftw_room(f->length))) {
        fftw_make_planner_thread_safe(); /* all plugins of the process share FFTW's planner */
        /* an estimated plan depends only on the length, so that results are reproducible to the
           last bit */
        f->forward = fftw_plan_dft_r2c_1d((int)f->length, f->line, f->image,
                                          FFTW_ESTIMATE | FFTW_PRESERVE_INPUT);
        f->backward = fftw_plan_dft_c2r_1d((int)f->length, f->image, f->bent, FFTW_ESTIMATE);
    }
    if (!f->forward || !f->backward) {
        ehl_fft_destroy(f);
        return NULL;
    }
    for (size_t k = 0; k <= last; k++)
        f->line[k] = d[k];
    for (size_t k = 1; k < last; k++)
        f->line[f->length - k] = d[k];
    fftw_execute(f->forward);
    for (size_t k = 0; k < half; k++)
        f->spectrum[k] = f->image[k][0] / (double)f->length;
    memset(f->line, 0, f->length * sizeof *f->line);
    return f;
}

/* Multiplies complex numbers, stored as pairs, by real factors. */
FF_SIMD
static void multiply_pairs(size_t count, const double *restrict factor, double *restrict pairs)
{
    for (size_t k = 0; k < count; k++) {
        pairs[2 * k] *= factor[k];
        pairs[2 * k + 1] *= factor[k];
    }
}

void ehl_fft_apply(ehl_fft *f, const double *p, double *v)
{
    size_t half = f->length / 2 + 1;
    memcpy(f->line, p, f->nodes * sizeof *p);
    fftw_execute(f->forward);
    multiply_pairs(half, f->spectrum, (double *)f->image);
    fftw_execute(f->backward);
    memcpy(v, f->bent, f->nodes * sizeof *v);
}

void ehl_fft_destroy(ehl_fft *f)
{
    if (!f)
        return;
    fftw_destroy_plan(f->forward);
    fftw_destroy_plan(f->backward);
    free(f->line);
    free(f->bent);
    free(f->spectrum);
    free(f->image);
    free(f);
}
