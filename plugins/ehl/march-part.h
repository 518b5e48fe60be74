/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Declares what the files of the time marching share. */
#ifndef EHL_MARCH_PART_H
#define EHL_MARCH_PART_H

#include "march.h"

/* Most Newton steps from an extrapolated film, a carried film, the last film, and a first guess. */
enum {
    EHL_LIMIT_GUESSED = 12,
    EHL_LIMIT_REPEATED = 30,
    EHL_LIMIT_PLAIN = 25,
    EHL_LIMIT_START = 60
};

/* Computes masses and gaps of the trial, whose film and step are set. */
void ehl_march_update_mass(ehl_march *m);

/* Orients the nodes along the entrainment of `at` and places the rough flanks as they stand
   then. */
void ehl_march_place(ehl_march *m, const ehl_instant *at);

/* Rough flanks: sets the trial to the last film, carried along with the oil to `at`. */
void ehl_advect_film(ehl_march *m, const ehl_instant *at);

/* Returns the masses of the last two films, moved with the oil to the instant that is placed. */
void ehl_advect_mass(ehl_march *m, const double **one, const double **two);

/* Rough flanks: returns the cells by which the oil may move in a step: one, or half the inlet of an
   asperity where asperities are in contact or nearly so. */
double ehl_largest_advection(const ehl_march *m);

/* Moves the accumulated truncation on with the film by `distance` and adds that of the trial. */
void ehl_advect_error(ehl_march *m, double distance);

ehl_step ehl_instant_step(const ehl_march *m, const ehl_instant *at);
void ehl_copy_film(ehl_film *to, const ehl_film *from, size_t nodes);
double ehl_thinnest(ehl_march *m, double radius, const ehl_film *film);

/* Solves the trial for `step`; without load at the gap of `at`. */
ff_status ehl_solve_trial(ehl_march *m, ehl_step *step, const ehl_instant *at);

/* Solves it while the contact is lost: chooses between the prescribed gap and a balance of
   forces. */
ff_status ehl_solve_contact_loss(ehl_march *m, ehl_step *step, const ehl_instant *at);

/* Removes the pressure and leaves the oil where it is. */
void ehl_remove_pressure(ehl_film *film, const double *mass, size_t nodes);

#endif
