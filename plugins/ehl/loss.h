/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the film dissipates at an instant, and the friction of the flanks. */
#ifndef EHL_LOSS_H
#define EHL_LOSS_H

#include "results.h"

/* 1: an output that takes the shear stress is wanted, or one that takes the pressure flow. */
int ehl_loss_of_shear(uint64_t wanted);
int ehl_loss_of_flow(uint64_t wanted);

/* Friction and losses as far as they are wanted, in the newest row of the series. */
void ehl_loss_record(ehl_results *r, const ehl_march *m);

#endif
