/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Floquet multipliers of a motion with films. */
#ifndef DYNAMICS_MULTIPLIERS_H
#define DYNAMICS_MULTIPLIERS_H

/* The eigenvalues of the monodromy in (delta, rate, films), as complex pairs in falling order of
   their modulus, NaN when they cannot be had; returns the largest one. */
double dynamics_films_multipliers(const double m[4][4], double multipliers[8]);

#endif
