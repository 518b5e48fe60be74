/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decides which nodes are cavitated and how far a Newton step may go, and adjusts the load. */
#ifndef EHL_CAVITATION_H
#define EHL_CAVITATION_H

#include "solver.h"

/* State of the film boundary in a solution. The boundary would move by one node per Newton step.
 * While it keeps moving out, the number of nodes that it takes at once doubles. */
typedef struct ehl_cavitation {
    size_t stride;
    int split; /* 1: the last shrink cavitated nodes upstream of full ones */
    int moved; /* 1: nodes have changed state since the last growth or filling, other than by a
                  sufficient growth of one node */
    int grown; /* 1: the last growth filled nodes */
    unsigned char *filled; /* how often each node was filled in this solution */
    unsigned char *cut;    /* 1: cavitated by the last step, so that its oil is not yet known */
} ehl_cavitation;

/* Returns FF_OK or FF_NOMEM. */
ff_status ehl_cavitation_create(ehl_cavitation *w, size_t nodes);
void ehl_cavitation_destroy(ehl_cavitation *w);

/* Begins a new solution. */
void ehl_cavitation_begin(ehl_cavitation *w, size_t nodes);

/* Fills the cavitated nodes that gain mass. Returns 1 if the film is now longer than what was
 * evaluated. */
int ehl_cavitation_grow_film(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film);

/* With mass conserved: fills the nodes that hold more oil than their gap. Returns 1 if there were
 * any. A node that alternates between full and cavitated stays cavitated in the end, with too much
 * oil; the quality line `complementarity` shows it. In time steps a node whose pressure was cut off
 * waits for a step that finds its oil. Steady films of flanks that yield are not found that way. */
int ehl_cavitation_fill(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film, int steps);

/* Cavitates the nodes whose oil has a pressure below 0. Returns the largest pressure cut off, Pa.
 * `change` gets the changes of p, if there are any or if metal may yield. With statistical flanks r
 * has the gap of the film. */
double ehl_cavitation_shrink_film(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film,
                                  double *change);

/* Returns the scale for changes of pressure: the largest pressure of the film, but at least 1e-6 of
 * the largest Hertz pressure. */
double ehl_pressure_scale(const ehl_grid *g, const ehl_film *film, size_t nodes);

/* Returns the share of a Newton step to take; `dp` is its largest change of pressure and `dh` its
 * change of the film at each node. */
double ehl_step_share(const ehl_grid *g, const ehl_reynolds *r, const ehl_film *film, double dp,
                      const double *dh);

/* Removes a small error of the load by scaling the pressure, without a convolution. The film then
 * carries its load to rounding, however loosely the equations are solved. h00 changes so that the
 * gap at x = 0 stays. Returns 0 if the error of the load is not small. */
int ehl_rescale_to_load(ehl_solver *s, const ehl_step *step, ehl_film *film);

#endif
