/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of the marching share among themselves. */
#ifndef EHL_MARCH_PART_H
#define EHL_MARCH_PART_H

#include "march.h"

/* Newton steps allowed from an extrapolated, a repeated and a first guess. */
enum {
    EHL_LIMIT_GUESSED = 12,
    EHL_LIMIT_REPEATED = 30,
    EHL_LIMIT_PLAIN = 25,
    EHL_LIMIT_START = 60
};

/* Masses and gaps of the trial, whose film and step are set. */
void ehl_march_update_mass(ehl_march *m);

/* The nodes along the entrainment of `at`, and the rough flanks as they stand then. */
void ehl_march_place(ehl_march *m, const ehl_instant *at);

/* Rough flanks: trial = the last film, carried along with the oil to `at`. */
void ehl_advect_film(ehl_march *m, const ehl_instant *at);

/* The masses of the last two films, as far as the oil has taken them by the instant that is placed.
 */
void ehl_advect_mass(ehl_march *m, const double **one, const double **two);

/* Rough flanks: cells that the oil may move in a step: one, or half of an asperity's inlet where
   they touch or are about to. */
double ehl_largest_advection(const ehl_march *m);

/* What the film has gathered of truncations moves on with it by `distance`, and gains those of the
   trial. */
void ehl_advect_error(ehl_march *m, double distance);

ehl_step ehl_instant_step(const ehl_march *m, const ehl_instant *at);
void ehl_copy_film(ehl_film *to, const ehl_film *from, size_t nodes);
double ehl_thinnest(ehl_march *m, double radius, const ehl_film *film);

/* Solves the trial for `step`; without load at the gap of `at`. */
ff_status ehl_solve_trial(ehl_march *m, ehl_step *step, const ehl_instant *at);

/* The same while the contact is lost: chooses between the prescribed gap and a balance of forces.
 */
ff_status ehl_solve_contact_loss(ehl_march *m, ehl_step *step, const ehl_instant *at);

/* Takes the pressure off, and leaves the oil where it is. */
void ehl_remove_pressure(ehl_film *film, const double *mass, size_t nodes);

#endif
