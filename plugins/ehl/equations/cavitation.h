/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decides which nodes are cavitated and how far a Newton step may go, and adjusts the load. */
#ifndef EHL_CAVITATION_H
#define EHL_CAVITATION_H

#include "solver.h"

/* State of the film boundary in a solution. The boundary would move by only one node per Newton
   step. While it keeps moving outward, the number of nodes by which it moves doubles. */
typedef struct ehl_cavitation {
    size_t stride;
    int split; /* 1: the last shrinking cavitated nodes upstream of full nodes */
    int moved; /* 1: nodes have changed state since the last growth or filling, except by a growth
                  of one node that was sufficient */
    int grown; /* 1: the last growth filled nodes */
    unsigned char *filled; /* number of times that each node was filled in this solution */
    unsigned char *cut;    /* 1: the last step cavitated the node, so its mass of oil is not yet
                              known */
} ehl_cavitation;

/* Returns FF_OK or FF_NOMEM. */
ff_status ehl_cavitation_create(ehl_cavitation *w, size_t nodes);
void ehl_cavitation_destroy(ehl_cavitation *w);

/* Begins a new solution. */
void ehl_cavitation_begin(ehl_cavitation *w, size_t nodes);

/* Fills the cavitated nodes that gain mass. Returns 1 if the film is now longer than the film that
   was evaluated last. */
int ehl_cavitation_grow_film(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film);

/* With mass-conserving cavitation: fills the nodes that contain more oil than their gap. Returns 1
   if there were any. A node that alternates between full and cavitated finally stays cavitated with
   too much oil; the quality line `complementarity` shows this. In time steps (`steps` set) a node
   whose pressure was cut off is not filled before a Newton step has computed its oil. This delay is
   not used for steady films, since those of yielding flanks would not converge with it. */
int ehl_cavitation_fill(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film, int steps);

/* Cavitates the nodes whose oil has a pressure below 0. Returns the largest pressure cut off, Pa.
   Stores the changes of p in `change`, if there are changes or if metal may yield. For statistical
   flanks, r must contain the gap of the film. */
double ehl_cavitation_shrink_film(ehl_cavitation *w, const ehl_reynolds *r, ehl_film *film,
                                  double *change);

/* Returns the scale for changes of pressure: the largest pressure of the film, but at least 1e-6 of
 * the largest Hertz pressure. */
double ehl_pressure_scale(const ehl_grid *g, const ehl_film *film, size_t nodes);

/* Returns the share of a Newton step to take. `dp` is its largest change of pressure, and `dh` its
   change of the film at each node. */
double ehl_step_share(const ehl_grid *g, const ehl_reynolds *r, const ehl_film *film, double dp,
                      const double *dh);

/* Removes a small error of the load by scaling the pressure, without a convolution. The film then
   carries its load to round-off, even if the other equations are solved with a large tolerance. h00
   changes so that the gap at x = 0 is kept. Returns 0 if the error of the load is not small. */
int ehl_rescale_to_load(ehl_solver *s, const ehl_step *step, ehl_film *film);

#endif
