/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least-squares piecewise cubics through a table of many noisy samples over the mesh cycle.
 * Value and slope are continuous, except the slope at corners and both at jumps. */
#ifndef STIFFNESS_CUBIC_FIT_H
#define STIFFNESS_CUBIC_FIT_H

#include "interpolation.h"

typedef struct stiffness_cubic_fit {
    double *value;          /* of the cubics at the samples */
    double *before, *after; /* slopes at the breakpoints, as stiffness_cubic_at takes them */
    double error; /* largest distance from a sample, relative to the range of the samples */
} stiffness_cubic_fit;

/* `corner` flags the breakpoints at which the slope may jump; jumps are corners, too. Pieces are
 * halved until the error is within the tolerance, as long as they hold enough samples. False if
 * memory is short. */
bool stiffness_cubic_fit_make(stiffness_cubic_fit *fit, const stiffness_table_phases *points,
                              size_t samples, const double *value, const bool *corner,
                              double tolerance);
void stiffness_cubic_fit_free(stiffness_cubic_fit *fit);

#endif
