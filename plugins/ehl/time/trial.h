/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One implicit step in time: its film is the trial until it is accepted. */
#ifndef EHL_TRIAL_H
#define EHL_TRIAL_H

#include "../equations/march.h"

/* Orients the nodes along the entrainment of `at` and places the rough flanks as they stand
   then. */
void ehl_march_place(ehl_march *m, const ehl_instant *at);

/* Solves the trial for `step`; without load at the gap of `at`. */
ff_status ehl_solve_trial(ehl_march *m, ehl_step *step, const ehl_instant *at);

/* Computes masses and gaps of the trial, whose film and step are set. */
void ehl_march_update_mass(ehl_march *m);

/* Makes the trial the newest state. */
void ehl_march_accept(ehl_march *m);

#endif
