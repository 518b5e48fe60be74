/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sobol indices: the share of the variance that a group of inputs makes alone, and with the others.
 */
#include "estimate.h"

#include "../../../../memory/memory.h"

#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdlib.h>

enum { RESAMPLES = 200 };

/* First index by Janon et al. 2014 (ESAIM Probab. Stat. 18, 342, eq. 6), from pairs that share the
   inputs of the group alone; total index by Jansen 1999 (Comput. Phys. Commun. 117, 35), from pairs
   that share all other inputs. */
static void indices(const double *a, const double *b, const double *c, const size_t *rows,
                    size_t count, double *first, double *total)
{
    double mean = 0, square = 0, both = 0, apart = 0, mean_t = 0, square_t = 0, n = (double)count;
    double about = count ? a[rows[0]] : 0; /* shifts the values against cancellation */
    for (size_t i = 0; i < count; i++) {
        double x = a[rows[i]] - about, y = b[rows[i]] - about, z = c[rows[i]] - about;
        mean += (y + z) / 2;
        square += (y * y + z * z) / 2;
        both += y * z;
        apart += (x - z) * (x - z) / 2;
        mean_t += (x + z) / 2;
        square_t += (x * x + z * z) / 2;
    }
    *first = (both / n - mean * mean / (n * n)) / (square / n - mean * mean / (n * n));
    *total = apart / n / (square_t / n - mean_t * mean_t / (n * n));
}

/* The middle 95 % of the values from resampled rows (Efron 1979). */
static void bound(estimate *e, double *values)
{
    memory_sort(values, RESAMPLES, sizeof *values);
    e->low = values[RESAMPLES / 40];
    e->high = values[RESAMPLES - 1 - RESAMPLES / 40];
    e->error = (double)NAN;
}

size_t estimate_sobol(const double *a, const double *b, const double *c, size_t count,
                      size_t groups, uint64_t seed, estimate *first, estimate *total)
{
    size_t *rows = memory_alloc((count + 1) * sizeof *rows), n = 0;
    size_t *drawn = memory_alloc((count + 1) * sizeof *drawn);
    double *s = memory_alloc(RESAMPLES * sizeof *s), *t = memory_alloc(RESAMPLES * sizeof *t);
    gsl_rng *rng = memory_require(gsl_rng_alloc(gsl_rng_mt19937));
    for (size_t i = 0; i < count; i++) {
        bool whole = isfinite(a[i]) && isfinite(b[i]);
        for (size_t g = 0; g < groups; g++)
            whole = whole && isfinite(c[g * count + i]);
        if (whole)
            rows[n++] = i;
    }
    for (size_t g = 0; g < groups && n < 2; g++)
        first[g] = total[g] = (estimate){(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    for (size_t g = 0; g < groups && n > 1; g++) {
        const double *own = c + g * count;
        indices(a, b, own, rows, n, &first[g].value, &total[g].value);
        gsl_rng_set(rng, (unsigned long)(seed & 0xffffffff));
        for (size_t r = 0; r < RESAMPLES; r++) {
            for (size_t i = 0; i < n; i++)
                drawn[i] = rows[gsl_rng_uniform_int(rng, n)];
            indices(a, b, own, drawn, n, &s[r], &t[r]);
        }
        bound(&first[g], s);
        bound(&total[g], t);
    }
    gsl_rng_free(rng);
    free(rows);
    free(drawn);
    free(s);
    free(t);
    return n;
}

static double between(double value, double low, double high)
{
    return isfinite(value) ? fmin(fmax(value, low), high) : value;
}

static void clip(estimate *e, double most)
{
    if (isnan(e->value))
        return;
    e->value = between(e->value, 0, most);
    e->low = fmin(between(e->low, 0, 1), e->value);
    e->high = fmax(between(e->high, 0, 1), e->value);
}

void estimate_tell_shares(estimate *first, estimate *total, size_t groups, size_t count)
{
    const estimate untold = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    double least = 1.96 / sqrt((double)count), sum = 0;
    for (size_t g = 0; g < groups; g++) {
        clip(&total[g], 1);
        clip(&first[g], total[g].value);
        if (!(first[g].value >= least) && total[g].value > 0)
            first[g] = untold;
        sum += isfinite(first[g].value) ? first[g].value : 0;
    }
    for (size_t g = 0; g < groups && sum > 1 + least; g++)
        if (first[g].value > 0)
            first[g] = untold;
}
