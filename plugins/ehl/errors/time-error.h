/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of the pressure peak due to the time steps. */
#ifndef EHL_TIME_ERROR_H
#define EHL_TIME_ERROR_H

#include "results.h"

/*
 * Returns the error of the pressure at x that a film error causes, Pa. Where the oil is only
 * transported, the flanks are deflected by d = e h, with e the relative error at the nodes, under
 * an unchanged load and except for h00:
 *   dp(x) = E'/(4 pi (a^2 - x^2)^(1/2)) PV int (a^2 - s^2)^(1/2) d'(s)/(x - s) ds,  |x| < a
 * (Johnson 1985, Contact Mechanics, 2.7; docs/theory.md, 12.11). x is the position of a node.
 */
double ehl_pressure_of_error(const ehl_reynolds *eq, const double *error, double modulus, double a,
                             double x);

/* Records the error of p_max due to the time steps in the newest film. `peak` is the node of
   p_max. */
void ehl_results_peak_in_time(ehl_results *r, const ehl_march *m, size_t peak, double p_max);

/* Returns by how much parabolas in time through neighbouring instants exceed the extreme of all
   instants, relative to it: the highest value with way = 1, the lowest with -1. Between the first
   two and the last two instants of an engagement nothing is computed. */
double ehl_beyond_instants(const ehl_results *r, uint32_t column, double way);

#endif
