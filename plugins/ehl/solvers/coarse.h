/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coarse grid for the long waves of the pressure, which the band matrix does not represent. Its
   equations are the balances of mass over blocks of nodes. Pressure and deflection are linear
   between corners; every `stride`-th node is a corner. */
#ifndef EHL_COARSE_H
#define EHL_COARSE_H

#include "../equations/reynolds.h"

typedef struct ehl_coarse ehl_coarse;

/* stride must be at least 4. Returns NULL if out of memory. */
ehl_coarse *ehl_coarse_create(size_t nodes, size_t stride, const double *kernel);
void ehl_coarse_destroy(ehl_coarse *c);

/* Returns 1 if the last system has a block for every node upstream of `last`. */
int ehl_coarse_fits(const ehl_coarse *c, size_t last);

/* Makes the system from r->by_p and r->by_h. If it is singular, the next solutions skip it. */
void ehl_coarse_factor(ehl_coarse *c, const ehl_reynolds *r, const ehl_film *film, int loaded);

/* Finds the pressure dp and the change dh of the film (deflection and dh00) that cancel the block
   sums of `residual` and the missing load `sum`, at the nodes 0 ... last. Returns 0 if there is no
   such solution. */
int ehl_coarse_solve(ehl_coarse *c, size_t last, const double *residual, double sum,
                     const ehl_film *film, double *dp, double *dh, double *dh00);

#endif
