/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the pairs share the mesh force of an instant. */
#ifndef DYNAMICS_SHARE_H
#define DYNAMICS_SHARE_H

#include "inputs.h"

/* Levels out of those of a stiffness; kept NULL: all. */
typedef struct dynamics_chosen_levels {
    const dynamics_force_levels *of;
    const size_t *kept;
    size_t count;
} dynamics_chosen_levels;

/* The tooth force at a station, N. A further pair that touches between two levels bends it there:
   between them it follows the lines of the intervals before and behind, up to where these meet, and
   the straight line between both levels where they do not. Of two pairs both bend at one force, so
   that their forces add up to the mesh force. */
double dynamics_tooth_force(const dynamics_chosen_levels *levels, double force, size_t station);

/* The share of the pair at a station under a mesh force, N: that of the mean force, Li & Kahraman
   2011, eq. 5, W_d = (W_s/F) DMF; or, with a shared force, straight between the levels, so that the
   shares of all pairs add up to 1. Below the least level above 0, in flight, too, it is the share
   there, and above the largest that of the largest. */
double dynamics_share(const dynamics_inputs *inputs, size_t station, double force);

#endif
