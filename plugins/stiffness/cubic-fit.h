/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Least-squares piecewise cubics through a table of many, noisy samples over the mesh cycle: value
 * and slope are continuous but for the slope at corners and for both at jumps.
 */
#ifndef STIFFNESS_CUBIC_FIT_H
#define STIFFNESS_CUBIC_FIT_H

#include "interpolation.h"

typedef struct stiffness_cubic_fit {
    double *value;          /* of the cubics at the samples */
    double *before, *after; /* slopes at the breakpoints, for stiffness_cubic_at */
    double error;           /* largest distance from a sample, over the range of the samples */
} stiffness_cubic_fit;

/* `corner` flags the breakpoints where the slope may change at once; jumps are corners too. Pieces
   are halved until the error is no more than the tolerance, as long as there are enough samples for
   them. False: out of memory. */
bool stiffness_cubic_fit_make(stiffness_cubic_fit *fit, const stiffness_table_phases *points,
                              size_t samples, const double *value, const bool *corner,
                              double tolerance);
void stiffness_cubic_fit_free(stiffness_cubic_fit *fit);

#endif
