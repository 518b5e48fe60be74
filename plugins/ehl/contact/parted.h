/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film of flanks that never touch, such as those of floating gears: the gap, without
   pressure. */
#ifndef EHL_PARTED_H
#define EHL_PARTED_H

#include "history.h"

/* Returns 1 if the contact is never loaded. */
int ehl_is_parted(const ehl_history *history);

/* Writes each wanted output: the gap for a film, 0 for a pressure or a loss. `temperature`:
   temperature of the teeth, K; `roughness`: combined Rq, m. Returns FF_UNSUPPORTED for an output
   that has no value without load. `estimate`: the outputs are those of the estimates (ports.h). */
ff_status ehl_put_parted(const ff_host *host, int estimate, uint64_t wanted,
                         const ehl_history *history, double roughness, double temperature);

#endif
