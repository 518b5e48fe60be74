/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A line force that swings as gear 1 turns. Its orders seldom fit into a mesh cycle: then the
 * excitation repeats itself after several of these, which are one cycle of the motion.
 */
#ifndef DYNAMICS_FLUCTUATION_H
#define DYNAMICS_FLUCTUATION_H

#include "excitation.h"

#include <flankfilm/plugin.h>

/* The force cosine cos(a) + sine sin(a), N, of each order, a = 2 pi order/teeth mesh cycles. */
typedef struct dynamics_fluctuation {
    size_t count; /* 0: the force is constant */
    double teeth; /* of gear 1 */
    const double *order, *cosine, *sine;
} dynamics_fluctuation;

/* Reads and checks; `in` is the row of the orders, which the others follow. */
ff_status dynamics_fluctuation_read(const ff_host *host, const ff_array *in, double teeth,
                                    dynamics_fluctuation *fluctuation, size_t *span);

/* The sum of the amplitudes, N. */
double dynamics_fluctuation_size(const dynamics_fluctuation *fluctuation);

/* Makes one cycle of `span` mesh cycles, with what the force swings by as a drag below 0. 0: out of
   memory. */
int dynamics_excitation_fluctuate(dynamics_excitation *excitation,
                                  const dynamics_fluctuation *fluctuation, size_t span);

#endif
