/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which nodes are cavitated, and how far one Newton step may go. */
#ifndef EHL_WET_H
#define EHL_WET_H

#include "reynolds.h"

/* A front of the film moves one node per Newton step; while fronts keep moving out, the nodes taken
   at once double. */
typedef struct ehl_wet {
    size_t stride;
    int torn;              /* the last shrink dried nodes in front of wet ones */
    unsigned char *filled; /* how often ehl_wet_fill wetted a node in this solution */
} ehl_wet;

/* FF_NOMEM */
ff_status ehl_wet_create(ehl_wet *w, size_t nodes);
void ehl_wet_destroy(ehl_wet *w);

/* A new solution. */
void ehl_wet_begin(ehl_wet *w, size_t nodes);

/* Wets the dry nodes that gain mass. 1: the film is now longer than what was evaluated. */
int ehl_wet_grow(ehl_wet *w, const ehl_reynolds *r, ehl_film *film);

/* With mass conserved: wets the nodes that hold more than the gap. 1: there were some. A node that
   keeps being wetted and dried stays void in the end, overfull: complementarity tells. */
int ehl_wet_fill(ehl_wet *w, const ehl_reynolds *r, ehl_film *film);

/* Dries the nodes with p < 0 and returns the largest |p| that was cut off; `change` is what p
   changed by. */
double ehl_wet_shrink(ehl_wet *w, const ehl_reynolds *r, ehl_film *film, double *change);

/* Pressure that changes are measured against: the film's largest, not below 1e-6 of Hertz. */
double ehl_pressure_scale(const ehl_grid *g, const ehl_film *film, size_t nodes);

/* Part of a Newton step that is taken: `dp` is its largest change of pressure, dh its change of the
   film at each node. */
double ehl_step_share(const ehl_grid *g, const ehl_reynolds *r, const ehl_film *film, double dp,
                      const double *dh);

#endif
