/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of the pressure peak by the time steps. */
#ifndef EHL_TIME_ERROR_H
#define EHL_TIME_ERROR_H

#include "results.h"

/*
 * What a film that is off makes of the pressure at x, Pa. Where the oil is carried along the flanks
 * bend by d = e h, with e the error at the nodes, over h, under an unchanged load and but for h00:
 *   dp(x) = E'/(4 pi (a^2 - x^2)^(1/2)) PV int (a^2 - s^2)^(1/2) d'(s)/(x - s) ds,  |x| < a
 * (Johnson 1985, Contact Mechanics, 2.7; docs/theory.md, 12.11). x is that of a node.
 */
double ehl_pressure_of_error(const ehl_reynolds *eq, const double *error, double modulus, double a,
                             double x);

/* Keeps what the steps have made of p_max, that of node `peak`, in the newest film. */
void ehl_results_peak_in_time(ehl_results *r, const ehl_march *m, size_t peak, double p_max);

/* By how much parabolas in time through neighbours go beyond the extreme of all instants, over it:
   of the highest value with way = 1, of the lowest with -1. Between the first two and the last two
   of an engagement nothing is looked for. */
double ehl_beyond_instants(const ehl_results *r, uint32_t column, double way);

#endif
