/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The semi-system matrix of a line of nodes: derivatives of each balance with respect to the
   pressures of nearby nodes. These pressures act through the pressure flow and through the
   deflection of the film. The deflection by distant nodes is not included. The kernel is shifted so
   that it ends in 0 after the last included node; the border of the matrix, for load and h00,
   represents the shift exactly. */
#ifndef EHL_LINE_H
#define EHL_LINE_H

#include "../equations/reynolds.h"

typedef struct ehl_line_matrix ehl_line_matrix;

ehl_line_matrix *ehl_line_create(size_t nodes, const double *kernel); /* NULL: out of memory */
void ehl_line_destroy(ehl_line_matrix *m);

/* Makes the matrix from r->by_p and r->by_h, as computed by ehl_asymmetric_slopes. */
void ehl_line_factor(ehl_line_matrix *m, const ehl_reynolds *r, const ehl_film *film, int loaded);

/* Solves for dp and dh00: the balances = residual (rows 1 ... last - 1) and, if loaded, the sum of
   dp = sum. dp is 0 elsewhere. */
void ehl_line_solve(ehl_line_matrix *m, const double *residual, double sum, double *dp,
                    double *dh00);

#endif
