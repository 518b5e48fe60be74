/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A line force that fluctuates with the rotation of gear 1. Its orders rarely have the period of
 * the mesh. The excitation then repeats after several mesh cycles, which together form one cycle of
 * the motion.
 */
#ifndef DYNAMICS_FLUCTUATION_H
#define DYNAMICS_FLUCTUATION_H

#include "excitation.h"

#include <flankfilm/plugin.h>

/* Fluctuating force (N): the sum of cosine cos(a) + sine sin(a) over the orders, with a = 2 pi
   order/teeth times the time in mesh cycles. */
typedef struct dynamics_fluctuation {
    size_t count; /* 0: the force is constant */
    double teeth; /* number of teeth of gear 1 */
    const double *order, *cosine, *sine;
} dynamics_fluctuation;

/* Reads and checks the fluctuation. `in` points to the input row of the orders, after which the
   other rows of the fluctuation follow. `span`: mesh cycles after which force and mesh repeat. */
ff_status dynamics_fluctuation_read(const ff_host *host, const ff_array *in, double teeth,
                                    dynamics_fluctuation *fluctuation, size_t *span);

/* Returns the sum of the amplitudes, N. */
double dynamics_fluctuation_size(const dynamics_fluctuation *fluctuation);

/* Expands the excitation to a period of `span` mesh cycles. The fluctuating force becomes a drag
   with opposite sign. Returns 0 if out of memory. */
int dynamics_excitation_fluctuate(dynamics_excitation *excitation,
                                  const dynamics_fluctuation *fluctuation, size_t span);

#endif
