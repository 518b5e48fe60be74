/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of the marching share among themselves. */
#ifndef FF_EHL_MARCH_PART_H
#define FF_EHL_MARCH_PART_H

#include "march.h"

/* Newton steps allowed from an extrapolated, a repeated and a first guess. */
enum { FF_LIMIT_GUESSED = 12, FF_LIMIT_CARRIED = 30, FF_LIMIT_PLAIN = 25, FF_LIMIT_START = 60 };

/* Masses and gaps of the trial, whose film and step are set. */
void ff_march_weigh(ff_march *m);

/* The nodes along the entrainment of `at`, and the rough flanks as they stand then. */
void ff_march_place(ff_march *m, const ff_instant *at);

/* Rough flanks: trial = the last film, carried along with the oil to `at`. */
void ff_carry_on(ff_march *m, const ff_instant *at);

/* The masses of the last two films, as far as the oil has taken them by the instant that is placed.
 */
void ff_follow(ff_march *m, const double **one, const double **two);

/* Rough flanks: cells that the oil may move in a step: one, or half of an asperity's inlet where
   they touch or are about to. */
double ff_stride(const ff_march *m);

/* What the film has gathered of truncations moves on with it by `distance`, and gains those of the
   trial. */
void ff_carry_drift(ff_march *m, double distance);

ff_step ff_instant_step(const ff_march *m, const ff_instant *at);
void ff_copy_film(ff_film *to, const ff_film *from, size_t nodes);
double ff_thinnest(ff_march *m, double radius, const ff_film *film);

/* Solves the trial for `step`; without load at the gap of `at`. */
ff_status ff_solve_trial(ff_march *m, ff_step *step, const ff_instant *at);

/* The same in flight: chooses between the prescribed gap and a balance of forces. */
ff_status ff_fly(ff_march *m, ff_step *step, const ff_instant *at);

/* Takes the pressure off, and leaves the oil where it is. */
void ff_strip(ff_film *film, const double *mass, size_t nodes);

#endif
