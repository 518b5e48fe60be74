/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Acceleration of a relaxation y <- y + g(y): Anderson 1965, J. ACM 12; Walker & Ni 2011, SIAM J.
 * Numer. Anal. 49. The change is the one for which the last changes of y and g, taken as linear,
 * promise the least g.
 */
#ifndef FF_EHL_MIXING_H
#define FF_EHL_MIXING_H

#include <stddef.h>

enum { FF_MIXING_DEPTH = 24 };

typedef struct ff_mixing {
    size_t size, count; /* count: changes that are known */
    size_t newest;
    int started;
    double *memory;
    double *y, *g; /* of the last call */
    double *dy[FF_MIXING_DEPTH], *dg[FF_MIXING_DEPTH];
    double *basis[FF_MIXING_DEPTH]; /* of the dg, orthonormal, newest first */
} ff_mixing;

/* 0: out of memory */
int ff_mixing_create(ff_mixing *m, size_t size);
void ff_mixing_destroy(ff_mixing *m);

/* Forgets what it knows. */
void ff_mixing_begin(ff_mixing *m);

/* The change of y, in place of the plain g. */
void ff_mixing_step(ff_mixing *m, const double *y, const double *g, double *change);

#endif
