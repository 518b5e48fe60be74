/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One implicit step in time. Its film is the trial until it is accepted. */
#ifndef EHL_TRIAL_H
#define EHL_TRIAL_H

#include "../equations/march.h"

/* Orients the nodes along the entrainment of `at`, and places the rough flanks where they are at
   that instant. */
void ehl_march_place(ehl_march *m, const ehl_instant *at);

/* Solves for the trial of `step`. Without load the gap is that of `at`. */
ff_status ehl_solve_trial(ehl_march *m, ehl_step *step, const ehl_instant *at);

/* Computes masses and gaps of the trial. Its film and step are already set. */
void ehl_march_update_mass(ehl_march *m);

/* Makes the trial the newest state. */
void ehl_march_accept(ehl_march *m);

#endif
