/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gauss-Legendre-Lobatto nodes across a film, from 0 at flank 1 to 1 at flank 2, with matrices for
   derivatives and integrals. */
#ifndef EHL_ACROSS_H
#define EHL_ACROSS_H

#include "../contact/simd-reductions.h"

#include <stddef.h>

enum { EHL_ACROSS_LEAST = 4, EHL_ACROSS_PRESET = 8, EHL_ACROSS_MOST = 32, EHL_ACROSS_FINE = 17 };

typedef double ehl_across_matrix[EHL_ACROSS_MOST][EHL_ACROSS_MOST];

typedef struct ehl_across {
    size_t count;
    double z[EHL_ACROSS_MOST];
    double weight[EHL_ACROSS_MOST]; /* weights of the integral; exact for polynomials up to the
                                       degree 2 count - 3 */
    /* d/dz; row l, column k: derivative at node k of the polynomial that is 1 at node l and 0 at
       the others */
    ehl_across_matrix slope;
    ehl_across_matrix integral;                    /* integral from 0 to node k */
    ehl_across_matrix stiffness;                   /* int (dv/dz) (dT/dz) dz */
    ehl_across_matrix damping;                     /* stiffness of the highest modes only */
    double fine[EHL_ACROSS_FINE][EHL_ACROSS_MOST]; /* values at equidistant points */
    double swing; /* largest of these values for polynomials between -1 and 1 at the nodes */
} ehl_across;

/* Sets out[k] to the sum of m[l * stride + k] values[l] over l < n, for k < n. The rows of the
   matrix and the output are padded to a multiple of EHL_LANES. */
FF_SIMD_INLINE void ehl_across_apply(const double *m, size_t stride, size_t n, const double *values,
                                     double *out)
{
    for (size_t k = 0; k < n; k += EHL_LANES) {
        ehl_lanes sum = {0}, row;
        for (size_t l = 0; l < n; l++) {
            memcpy(&row, m + l * stride + k, sizeof row);
            sum += values[l] * row;
        }
        memcpy(out + k, &sum, sizeof sum);
    }
}

/* Returns the largest of `most` and of EHL_ACROSS_FINE values of the polynomial through the values
 * at the nodes. */
double ehl_across_highest(const ehl_across *a, const double *values, double most);

/* Evaluates the polynomials through `values`, one for each column, at the nodes of another set
   `other`. */
void ehl_across_move(const ehl_across *a, const ehl_across *other, size_t columns,
                     const double *values, double *to);

/* Creates EHL_ACROSS_LEAST to EHL_ACROSS_MOST nodes. */
void ehl_across_create(ehl_across *a, size_t count);

#endif
