/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Anderson acceleration of a relaxation y <- y + g(y) (Anderson 1965, J. ACM 12; Walker & Ni 2011,
   SIAM J. Numer. Anal. 49). The last changes of y and g form a linear model. The step minimises the
   norm of the g that this model predicts. */
#ifndef EHL_ANDERSON_H
#define EHL_ANDERSON_H

#include <stddef.h>

enum { EHL_ANDERSON_DEPTH = 8 };

typedef struct ehl_anderson {
    size_t size, count; /* count: number of stored changes */
    size_t newest;
    int started;
    double *memory;
    double *y, *g; /* values at the last call */
    double *dy[EHL_ANDERSON_DEPTH], *dg[EHL_ANDERSON_DEPTH];
    double *basis[EHL_ANDERSON_DEPTH]; /* orthonormal basis of the changes of g, newest first */
} ehl_anderson;

/* Returns 0 if out of memory. */
int ehl_anderson_create(ehl_anderson *m, size_t size);
void ehl_anderson_destroy(ehl_anderson *m);

/* Removes all stored changes. */
void ehl_anderson_begin(ehl_anderson *m);

/* Computes the accelerated change of y, to be applied instead of g. */
void ehl_anderson_step(ehl_anderson *m, const double *y, const double *g, double *change);

#endif
