/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least-squares piecewise cubics through a table of many noisy samples over the mesh cycle. Value
   and slope are continuous; at corners the slope may jump, at jumps both. */
#ifndef STIFFNESS_CUBIC_FIT_H
#define STIFFNESS_CUBIC_FIT_H

#include "interpolation.h"

typedef struct stiffness_cubic_fit {
    double *value;          /* values of the cubics at the samples */
    double *before, *after; /* slopes before and after each breakpoint, for stiffness_cubic_at */
    double error; /* largest distance from a sample, relative to the range of the samples */
} stiffness_cubic_fit;

/* `corner` flags the breakpoints at which the slope may jump; jumps are corners, too. Pieces are
   halved until the error is within the tolerance or they have too few samples. Returns false if out
   of memory. */
bool stiffness_cubic_fit_make(stiffness_cubic_fit *fit, const stiffness_table_phases *points,
                              size_t samples, const double *value, const bool *corner,
                              double tolerance);
void stiffness_cubic_fit_free(stiffness_cubic_fit *fit);

#endif
