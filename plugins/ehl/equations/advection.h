/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moves pressure, state and mass of a rough film with the oil. */
#ifndef EHL_ADVECTION_H
#define EHL_ADVECTION_H

#include "march.h"

/* Rough flanks: sets the trial film to the last film, transported with the oil to the instant
   `at`. */
void ehl_advect_film(ehl_march *m, const ehl_instant *at);

/* Sets `to` to the values of the state, `each` per node, transported with the oil to the current
   instant. */
void ehl_advect_values(const ehl_march *m, const ehl_state *s, size_t each, const double *from,
                       double *to);

/* Returns the node of an earlier state at which the oil now at node i was. */
size_t ehl_upstream_node(const ehl_march *m, const ehl_state *s, size_t i);

/* Returns the masses of the last two films, transported with the oil to the current instant. */
void ehl_advect_mass(ehl_march *m, const double **one, const double **two);

/* Rough flanks: returns the largest distance that the oil may move in a step, in cells. It is one
   cell, or several if the cells are finer than the shortest waves need. If asperities carry load,
   the distance is half the inlet length of an asperity. */
double ehl_largest_advection(const ehl_march *m);

#endif
