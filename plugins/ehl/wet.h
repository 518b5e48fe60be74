/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which nodes are cavitated, and how far one Newton step may go. */
#ifndef FF_EHL_WET_H
#define FF_EHL_WET_H

#include "reynolds.h"

/* A front of the film moves one node per Newton step; while fronts keep moving out, the nodes taken
   at once double. */
typedef struct ff_wet {
    size_t stride;
    int torn; /* the last shrink dried nodes in front of wet ones */
} ff_wet;

void ff_wet_begin(ff_wet *w);

/* Wets the dry nodes that gain mass. 1: the film is now longer than what was evaluated. */
int ff_wet_grow(ff_wet *w, const ff_reynolds *r, ff_film *film);

/* Dries the nodes with p < 0 and returns the largest |p| that was cut off; `change` is what p
   changed by. */
double ff_wet_shrink(ff_wet *w, ff_film *film, size_t nodes, double *change);

/* Pressure that changes are measured against: the film's largest, not below 1e-6 of Hertz. */
double ff_pressure_scale(const ff_grid *g, const ff_film *film, size_t nodes);

/* Part of a Newton step that is taken: `dp` is its largest change of pressure, dh its change of the
   film at each node. */
double ff_step_share(const ff_grid *g, const ff_reynolds *r, const ff_film *film, double dp,
                     const double *dh);

#endif
