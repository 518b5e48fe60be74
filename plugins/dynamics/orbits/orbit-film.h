/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The films of an orbit: how they are eliminated from its return map, and their part in its
 * multipliers. */
#ifndef DYNAMICS_ORBIT_FILM_H
#define DYNAMICS_ORBIT_FILM_H

#include "orbit.h"

/* Sets the films at phase 0: those of the last map, corrected; in the first map the quasi-static
 * ones. */
void dynamics_films_start(const dynamics_flow *flow, double T, dynamics_orbit *orbit);

/* Sets the monodromy of a state in (delta, rate, films). */
void dynamics_films_monodromy(const dynamics_state *y, double m[4][4]);

/* Takes over the films at the end, and eliminates them from m, end and slope. */
void dynamics_films_eliminate(const dynamics_state *end, double T, dynamics_orbit *orbit);

/* Returns det(1 - M) for sign 1 and det(1 + M) for sign -1, of the monodromy in all states. */
double dynamics_films_test(const dynamics_orbit *orbit, double sign);

#endif
