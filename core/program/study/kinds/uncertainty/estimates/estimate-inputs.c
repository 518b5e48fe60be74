/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The inputs as control variates: z and z^2 - 1 of standard normal numbers have mean 0, so a
 * regression on them removes the spread that they explain at no cost. The correction of a value
 * uses the other values alone, beta_(-i) = beta - A^-1 x_i e_i / (1 - h_i) (Sherman & Morrison
 * 1950), so that the mean stays unbiased.
 */
#include "estimate.h"

#include "../../../../memory/memory.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>

/* Samples needed for each coefficient: with fewer, the coefficients' own errors outweigh their
   gain. */
enum { SAMPLES_EACH = 3 };

/* Number of columns beside the constant one: none, the numbers, or the numbers and their
   squares. */
static size_t columns_for(size_t count, size_t inputs)
{
    return count >= SAMPLES_EACH * (2 * inputs + 1) ? 2 * inputs
           : count >= SAMPLES_EACH * (inputs + 1)   ? inputs
                                                    : 0;
}

static void fill_row(gsl_vector *x, const double *numbers, size_t inputs)
{
    gsl_vector_set(x, 0, 1);
    for (size_t k = 1; k < x->size; k++) {
        double z = numbers[(k - 1) % inputs];
        gsl_vector_set(x, k, k > inputs ? z * z - 1 : z);
    }
}

/* Fills A = sum x x' and b = sum x y. */
static void add_up(const double *values, const double *numbers, size_t count, size_t inputs,
                   gsl_matrix *a, gsl_vector *b, gsl_vector *x)
{
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(values[i]))
            continue;
        fill_row(x, numbers + i * inputs, inputs);
        gsl_blas_dsyr(CblasLower, 1, x, a);
        gsl_blas_daxpy(values[i], x, b);
    }
}

double estimate_explained(const double *values, const double *numbers, size_t count, size_t inputs,
                          double *part)
{
    estimate_moments m = estimate_pairs(values, values, count, NULL, 0);
    size_t columns = inputs ? columns_for((size_t)m.count, inputs) : 0;
    for (size_t i = 0; i < count; i++)
        part[i] = isfinite(values[i]) ? 0 : (double)NAN;
    if (columns == 0 || !(m.aa > 0))
        return 1;
    gsl_matrix *a = memory_require(gsl_matrix_calloc(columns + 1, columns + 1));
    gsl_vector *b = memory_require(gsl_vector_calloc(columns + 1));
    gsl_vector *x = memory_require(gsl_vector_alloc(columns + 1));
    gsl_vector *v = memory_require(gsl_vector_alloc(columns + 1));
    double squares = 0;
    add_up(values, numbers, count, inputs, a, b, x);
    gsl_linalg_cholesky_decomp1(a);
    gsl_linalg_cholesky_svx(a, b);
    for (size_t i = 0; i < count; i++) {
        double fitted, leverage;
        if (!isfinite(values[i]))
            continue;
        fill_row(x, numbers + i * inputs, inputs);
        gsl_linalg_cholesky_solve(a, x, v);
        gsl_blas_ddot(x, b, &fitted);
        gsl_blas_ddot(x, v, &leverage);
        double rest = values[i] - fitted, ahead = rest / (1 - leverage);
        squares += rest * rest;
        part[i] = fitted - gsl_vector_get(b, 0) - (leverage - gsl_vector_get(v, 0)) * ahead;
    }
    gsl_matrix_free(a);
    gsl_vector_free(b);
    gsl_vector_free(x);
    gsl_vector_free(v);
    return fmin(1, squares / m.aa * (m.count - 1) / (m.count - 1 - (double)columns));
}
