/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decides which nodes are cavitated, how far one Newton step may go, and takes up the load. */
#ifndef EHL_CAVITATION_H
#define EHL_CAVITATION_H

#include "solver.h"

/* The film boundary would move by one node per Newton step; while it keeps moving out, the number
   of nodes that it takes at once doubles. */
typedef struct ehl_cavitation {
    size_t stride;
    int split;             /* the last shrink cavitated nodes upstream of full ones */
    int moved;             /* nodes changed their state since the last growth or filling began,
                              otherwise than by a growth of one node that is enough */
    int grown;             /* the last growth filled nodes */
    unsigned char *filled; /* how often ehl_cavitation_fill filled a node in this solution */
    unsigned char *cut;    /* 1: cavitated by the last step, so that its oil is not known yet */
} ehl_cavitation;

/* FF_NOMEM */
ff_status ehl_cavitation_create(ehl_cavitation *w, size_t nodes);
void ehl_cavitation_destroy(ehl_cavitation *w);

/* Begins a new solution. */
void ehl_cavitation_begin(ehl_cavitation *w, size_t nodes);

/* Fills the cavitated nodes that gain mass. Returns 1 when the film is now longer than what was
   evaluated. */
int ehl_cavitation_grow_film(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film);

/* With mass conserved: fills the nodes that hold more than their gap. Returns 1 when there were
   some. A node that alternates between full and cavitated stays cavitated in the end, with more oil
   than its gap; the quality line `complementarity` shows it. In time steps a node whose pressure
   was cut off waits for one that finds its oil; steady films of flanks that yield are not found
   that way. */
int ehl_cavitation_fill(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film, int steps);

/* Cavitates the nodes where the pressure of the oil is below 0 and returns the largest part of it
   that was cut off, Pa; fills `change` with the changes of p if there are any, or if metal may
   yield. With statistical flanks r has the gap of the film. */
double ehl_cavitation_shrink_film(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film,
                                  double *change);

/* Returns the pressure that changes are measured against: the largest of the film, but at least
   1e-6 of the largest Hertz pressure. */
double ehl_pressure_scale(const ehl_grid *g, const ehl_film *film, size_t nodes);

/* Returns the share of a Newton step that is taken: `dp` is its largest change of pressure, `dh`
   its change of the film at each node. */
double ehl_step_share(const ehl_grid *g, const ehl_reynolds *r, const ehl_film *film, double dp,
                      const double *dh);

/* Removes a small error of the load by a factor on the pressure, which costs no convolution: the
   film then carries its load to rounding, however loosely the equations are solved. h00 changes so
   that the gap at x = 0 stays. Returns 0 when the error of the load is not small. */
int ehl_rescale_to_load(ehl_solver *s, const ehl_step *step, ehl_film *film);

#endif
