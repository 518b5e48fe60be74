/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What moves on with the oil: pressure, state and mass of a rough film. */
#ifndef EHL_ADVECTION_H
#define EHL_ADVECTION_H

#include "march.h"

/* Rough flanks: sets the trial to the last film, carried along with the oil to `at`. */
void ehl_advect_film(ehl_march *m, const ehl_instant *at);

/* Sets `to` to what the state has, `each` values per node, moved with the oil to the instant that
   is placed. */
void ehl_advect_values(const ehl_march *m, const ehl_state *s, size_t each, const double *from,
                       double *to);

/* The node of an earlier state that the oil at node i was at. */
size_t ehl_upstream_node(const ehl_march *m, const ehl_state *s, size_t i);

/* Returns the masses of the last two films, moved with the oil to the instant that is placed. */
void ehl_advect_mass(ehl_march *m, const double **one, const double **two);

/* Rough flanks: returns the cells by which the oil may move in a step: one, or more of cells that
   are finer than the shortest waves ask for, and half the inlet of an asperity where asperities
   carry load. */
double ehl_largest_advection(const ehl_march *m);

#endif
