/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far the sharing of the mean load, by which tooth forces are split and the mesh spring is
   made, is from that of the forces that the motion reaches. */
#ifndef DYNAMICS_SHARING_H
#define DYNAMICS_SHARING_H

#include "../excitation/inputs.h"

/* Largest changes between the mean force and another one. */
typedef struct dynamics_sharing_change {
    double share, slope; /* of the share of a pair; of the slope of the mesh, over that slope */
} dynamics_sharing_change;

/* The force is held within the levels above 0. */
dynamics_sharing_change dynamics_sharing_change_at(const dynamics_force_levels *levels, double mean,
                                                   double force);

/* The line sharing_change, by the least and the largest mesh force of the motion, N; none where the
   stiffness does not know its levels or the force is constant. */
void dynamics_sharing_report(const dynamics_inputs *inputs, double least, double largest,
                             const ff_host *host);

#endif
