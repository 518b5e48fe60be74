/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the film dissipates at an instant, and the friction of the flanks. */
#ifndef FF_EHL_LOSS_H
#define FF_EHL_LOSS_H

#include "results.h"

/* 1: an output that takes the shear stress is wanted, or one that takes the pressure flow. */
int ff_loss_of_shear(uint64_t wanted);
int ff_loss_of_flow(uint64_t wanted);

/* Friction and losses as far as they are wanted, in the newest row of the series. */
void ff_loss_record(ff_results *r, const ff_march *m);

#endif
