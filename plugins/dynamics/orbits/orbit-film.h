/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eliminates the films of an orbit from its return map, and includes them in its multipliers. */
#ifndef DYNAMICS_ORBIT_FILM_H
#define DYNAMICS_ORBIT_FILM_H

#include "orbit.h"

/* Sets the films at phase 0: the films of the last map with their correction, or quasi-static films
   for the first map. */
void dynamics_films_start(const dynamics_flow *flow, double T, dynamics_orbit *orbit);

/* Sets m to the monodromy of a state in (delta, rate, films). */
void dynamics_films_monodromy(const dynamics_state *y, double m[4][4]);

/* Copies the films at the end, and eliminates them from m, end and slope. */
void dynamics_films_eliminate(const dynamics_state *end, double T, dynamics_orbit *orbit);

/* Returns det(1 - M) for sign 1 and det(1 + M) for sign -1, with M the monodromy including the
   films. */
double dynamics_films_test(const dynamics_orbit *orbit, double sign);

#endif
