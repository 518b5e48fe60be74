/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which nodes are cavitated, and how far one Newton step may go. */
#ifndef EHL_CAVITATION_H
#define EHL_CAVITATION_H

#include "reynolds.h"

/* A front of the film moves one node per Newton step; while fronts keep moving out, the nodes taken
   at once double. */
typedef struct ehl_cavitation {
    size_t stride;
    int split;             /* the last shrink dried nodes in front of wet ones */
    unsigned char *filled; /* how often ehl_cavitation_fill wetted a node in this solution */
} ehl_cavitation;

/* FF_NOMEM */
ff_status ehl_cavitation_create(ehl_cavitation *w, size_t nodes);
void ehl_cavitation_destroy(ehl_cavitation *w);

/* A new solution. */
void ehl_cavitation_begin(ehl_cavitation *w, size_t nodes);

/* Wets the dry nodes that gain mass. 1: the film is now longer than what was evaluated. */
int ehl_cavitation_grow_film(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film);

/* With mass conserved: wets the nodes that hold more than the gap. 1: there were some. A node that
   keeps being wetted and dried stays void in the end, overfull: complementarity tells. */
int ehl_cavitation_fill(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film);

/* Dries the nodes with p < 0 and returns the largest |p| that was cut off; `change` is what p
   changed by. */
double ehl_cavitation_shrink_film(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film,
                                  double *change);

/* Pressure that changes are measured against: the film's largest, not below 1e-6 of Hertz. */
double ehl_pressure_scale(const ehl_grid *g, const ehl_film *film, size_t nodes);

/* Part of a Newton step that is taken: `dp` is its largest change of pressure, dh its change of the
   film at each node. */
double ehl_step_share(const ehl_grid *g, const ehl_reynolds *r, const ehl_film *film, double dp,
                      const double *dh);

#endif
