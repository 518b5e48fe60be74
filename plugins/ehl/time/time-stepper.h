/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Advances the film through time by implicit steps that are cut where they fail. */
#ifndef EHL_TIME_STEPPER_H
#define EHL_TIME_STEPPER_H

#include "../equations/march.h"

/* Advances to `time`, in one step unless it fails. FF_OK, or FF_NOCONV with `why`. */
ff_status ehl_march_to(ehl_march *m, double time);

/* Tries one implicit step to that instant: leaves the film in `trial` and its truncation in
   `local`. */
ff_status ehl_march_try(ehl_march *m, const ehl_instant *at);

/* Returns 1 when the film thins so fast in the trial, or changes so much as the contact opens or
   closes, that the step should be cut. */
int ehl_march_step_too_large(const ehl_march *m);

#endif
