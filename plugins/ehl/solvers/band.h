/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Preconditioner: the linearised balances with the elastic kernel cut off after a few nodes. The
   band matrix is factorised without pivoting; the balance of the load is a border of the matrix.
   The kernel is shifted by its value just after the cut, so that it ends in 0. For a given sum of
   pressures the shift changes the deflection of all nodes by the same amount, which the border
   represents exactly. */
#ifndef EHL_BAND_H
#define EHL_BAND_H

#include "../equations/reynolds.h"

typedef struct ehl_band ehl_band;

/* The column of a node has entries in the rows of this many nodes upstream of it. */
enum { EHL_BAND_REACH = 13 };

ehl_band *ehl_band_create(size_t nodes, const double *kernel); /* NULL: out of memory */
void ehl_band_destroy(ehl_band *b);

/* Factorises from r->by_p and r->by_h for the nodes `from` ... r->last - 1. The factors of the
   nodes 1 ... from - 1 are kept. */
void ehl_band_factor(ehl_band *b, const ehl_reynolds *r, const ehl_film *film, int loaded,
                     size_t from);

/* Solves for dp and dh00: the balances = residual at nodes 1 ... last - 1 and, if loaded, the sum
   of dp = sum. dp is set up to node last - 1 and unchanged after it. */
void ehl_band_solve(ehl_band *b, const double *residual, double sum, double *dp, double *dh00);

#endif
