/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Acceleration of a relaxation y <- y + g(y): Anderson 1965, J. ACM 12; Walker & Ni 2011, SIAM J.
 * Numer. Anal. 49. The change is the one for which the last changes of y and g, taken as linear,
 * promise the least g.
 */
#ifndef EHL_MIXING_H
#define EHL_MIXING_H

#include <stddef.h>

enum { EHL_MIXING_DEPTH = 24 };

typedef struct ehl_mixing {
    size_t size, count; /* count: changes that are known */
    size_t newest;
    int started;
    double *memory;
    double *y, *g; /* of the last call */
    double *dy[EHL_MIXING_DEPTH], *dg[EHL_MIXING_DEPTH];
    double *basis[EHL_MIXING_DEPTH]; /* of the dg, orthonormal, newest first */
} ehl_mixing;

/* 0: out of memory */
int ehl_mixing_create(ehl_mixing *m, size_t size);
void ehl_mixing_destroy(ehl_mixing *m);

/* Forgets what it knows. */
void ehl_mixing_begin(ehl_mixing *m);

/* The change of y, in place of the plain g. */
void ehl_mixing_step(ehl_mixing *m, const double *y, const double *g, double *change);

#endif
