/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Temperature of the teeth from the loss of their mesh. */
#ifndef LOSSES_BULK_H
#define LOSSES_BULK_H

#include "mesh-inputs.h"

/* Ranks of the words in LOSSES_BULK_RULES. */
enum { LOSSES_STANDARD, LOSSES_CONDUCTANCE, LOSSES_OIL };
#define LOSSES_BULK_RULES "standard|conductance|oil"

/* Ways to supply oil to the teeth. */
#define LOSSES_SUPPLIES "dip|spray|submerged"

/* Returns the temperature rise of the teeth above the oil by ISO/TR 15144-1, K, from the loss in W;
   `supply` is a rank in LOSSES_SUPPLIES, `relief` is X_Ca. */
double losses_standard_rise(const losses_mesh *m, double loss, int32_t supply, double relief);

#endif
