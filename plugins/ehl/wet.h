/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which nodes are cavitated, and how far one Newton step may go. */
#ifndef FF_EHL_WET_H
#define FF_EHL_WET_H

#include "reynolds.h"

/* A front of the film moves one node per Newton step; while fronts keep moving out, the nodes taken
   at once double. */
typedef struct ff_wet {
    size_t stride;
    int torn;              /* the last shrink dried nodes in front of wet ones */
    unsigned char *filled; /* how often ff_wet_fill wetted a node in this solution */
} ff_wet;

/* FF_NOMEM */
ff_status ff_wet_create(ff_wet *w, size_t nodes);
void ff_wet_destroy(ff_wet *w);

/* A new solution. */
void ff_wet_begin(ff_wet *w, size_t nodes);

/* Wets the dry nodes that gain mass. 1: the film is now longer than what was evaluated. */
int ff_wet_grow(ff_wet *w, const ff_reynolds *r, ff_film *film);

/* With mass conserved: wets the nodes that hold more than the gap. 1: there were some. A node that
   keeps being wetted and dried stays void in the end, overfull: complementarity tells. */
int ff_wet_fill(ff_wet *w, const ff_reynolds *r, ff_film *film);

/* Dries the nodes with p < 0 and returns the largest |p| that was cut off; `change` is what p
   changed by. */
double ff_wet_shrink(ff_wet *w, const ff_reynolds *r, ff_film *film, double *change);

/* Pressure that changes are measured against: the film's largest, not below 1e-6 of Hertz. */
double ff_pressure_scale(const ff_grid *g, const ff_film *film, size_t nodes);

/* Part of a Newton step that is taken: `dp` is its largest change of pressure, dh its change of the
   film at each node. */
double ff_step_share(const ff_grid *g, const ff_reynolds *r, const ff_film *film, double dp,
                     const double *dh);

#endif
