/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Advances the film through time by implicit steps, which are cut if they fail. */
#ifndef EHL_TIME_STEPPER_H
#define EHL_TIME_STEPPER_H

#include "../equations/march.h"

/* Advances to `time`, in one step unless it fails. Returns FF_OK, or FF_NOCONV with the reason in
   `why`. */
ff_status ehl_march_to(ehl_march *m, double time);

/* Tries one implicit step to that instant. The film is left in `trial`, its truncation error in
   `local`. */
ff_status ehl_march_try(ehl_march *m, const ehl_instant *at);

/* Returns 1 if a step should be cut because the film of the trial becomes thinner too fast, or
   changes too much while contact is lost or regained. */
int ehl_march_step_too_large(const ehl_march *m);

#endif
