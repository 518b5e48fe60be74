/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The long waves of the pressure, which banded factors do not see: the balances of mass over blocks
 * of nodes, for a pressure and a deflection that are linear from corner to corner, every
 * `stride`-th node.
 */
#ifndef EHL_COARSE_H
#define EHL_COARSE_H

#include "../equations/reynolds.h"

typedef struct ehl_coarse ehl_coarse;

/* stride >= 4. NULL: out of memory. */
ehl_coarse *ehl_coarse_create(size_t nodes, size_t stride, const double *kernel);
void ehl_coarse_destroy(ehl_coarse *c);

/* 1: the system that was made last has a block for every node upstream of `last`. */
int ehl_coarse_fits(const ehl_coarse *c, size_t last);

/* From r->by_p and r->by_h; a singular system is left alone by the solutions to come. */
void ehl_coarse_factor(ehl_coarse *c, const ehl_reynolds *r, const ehl_film *film, int loaded);

/*
 * The pressure dp and the change dh of the film, its deflection and dh00, that balance what the
 * blocks lack in `residual`, and the load, of which `sum` is missing; nodes 0 ... last.
 * 0: there is no such solution.
 */
int ehl_coarse_solve(ehl_coarse *c, size_t last, const double *residual, double sum,
                     const ehl_film *film, double *dp, double *dh, double *dh00);

#endif
