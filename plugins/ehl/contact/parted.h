/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film of flanks that never touch, such as those of floating gears: the gap, without
   pressure. */
#ifndef EHL_PARTED_H
#define EHL_PARTED_H

#include "history.h"

/* Returns 1 if the contact is never loaded. */
int ehl_is_parted(const ehl_history *history);

/* Gives each output that is wanted: the gap for a film, 0 for a pressure and a loss. `temperature`:
   K, of the teeth; `roughness`: combined Rq, m. FF_UNSUPPORTED for what has no value without a
   load. `estimate`: the outputs are those of the estimates. */
ff_status ehl_put_parted(const ff_host *host, int estimate, uint64_t wanted,
                         const ehl_history *history, double roughness, double temperature);

#endif
