/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Floquet multipliers of a motion with films. */
#ifndef DYNAMICS_MULTIPLIERS_H
#define DYNAMICS_MULTIPLIERS_H

/* Computes the eigenvalues of the monodromy in (delta, rate, films), as complex pairs in decreasing
   order of their modulus, or NaN if they cannot be computed. Returns the largest modulus. */
double dynamics_films_multipliers(const double m[4][4], double multipliers[8]);

#endif
