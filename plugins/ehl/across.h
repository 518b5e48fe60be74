/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nodes across a film, 0 at flank 1 to 1 at flank 2: those of Gauss, Legendre and Lobatto. */
#ifndef EHL_ACROSS_H
#define EHL_ACROSS_H

#include <stddef.h>

enum { EHL_ACROSS_LEAST = 4, EHL_ACROSS_PRESET = 8, EHL_ACROSS_MOST = 16, EHL_ACROSS_FINE = 17 };

typedef double ehl_across_matrix[EHL_ACROSS_MOST][EHL_ACROSS_MOST];

typedef struct ehl_across {
    size_t count;
    double z[EHL_ACROSS_MOST];
    double weight[EHL_ACROSS_MOST]; /* of an integral, exact up to the degree 2 count - 3 */
    ehl_across_matrix slope;        /* d/dz of the polynomial through values at the nodes */
    ehl_across_matrix integral;     /* [l][k]: from 0 to node k, of what is 1 at node l alone */
    ehl_across_matrix stiffness;    /* int (dv/dz) (dT/dz) dz */
    double fine[EHL_ACROSS_FINE][EHL_ACROSS_MOST]; /* values at equal distances */
} ehl_across;

/* Returns the highest value of the polynomial through values at the nodes, of EHL_ACROSS_FINE
 * places.
 */
double ehl_across_highest(const ehl_across *a, const double *values);

/* EHL_ACROSS_LEAST to EHL_ACROSS_MOST nodes. */
void ehl_across_create(ehl_across *a, size_t count);

#endif
