/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Least-squares piecewise cubics through a table of many, noisy samples over the mesh cycle: value
 * and slope are continuous but for the slope at corners and for both at jumps.
 */
#ifndef STIFFNESS_FIT_H
#define STIFFNESS_FIT_H

#include "knots.h"

typedef struct ff_fit {
    double *value;          /* of the cubics at the samples */
    double *before, *after; /* slopes at the knots, for stiffness_knots_cubic */
    size_t pieces;
    double error; /* largest distance from a sample, over the range of the samples */
} ff_fit;

/* `corner` flags the knots where the slope may change at once; jumps are corners too. Pieces are
   halved until the error is no more than the tolerance, as long as there are enough samples for
   them. False: out of memory. */
bool stiffness_fit_make(ff_fit *fit, const stiffness_knots *knots, size_t samples,
                        const double *value, const bool *corner, double tolerance);
void stiffness_fit_free(ff_fit *fit);

#endif
