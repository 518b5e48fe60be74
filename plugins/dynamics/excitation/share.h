/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The load sharing of the tooth pairs at a given mesh force. */
#ifndef DYNAMICS_SHARE_H
#define DYNAMICS_SHARE_H

#include "inputs.h"

/* A subset of the force levels of a stiffness; kept NULL: all levels. */
typedef struct dynamics_chosen_levels {
    const dynamics_force_levels *of;
    const size_t *kept;
    size_t count;
} dynamics_chosen_levels;

/* Returns the tooth force at a station, N, interpolated between force levels. If a further pair
   comes into contact between two levels, the curve has a kink there. It is approximated by
   extending the lines of the neighbouring intervals up to their intersection. If these lines do not
   intersect in the interval, the straight line between the two levels is used. Both pairs have
   their kink at the same force, so that their forces add up to the mesh force. */
double dynamics_tooth_force(const dynamics_chosen_levels *levels, double force, size_t station);

/* Returns the load share of the pair at a station under a mesh force, N. With a frozen force it is
   the share at the mean force: W_d = (W_s/F) DMF (Li & Kahraman 2011, eq. 5). With a shared force
   it is linear between the levels, so that the shares of all pairs add up to 1. Below the first
   level above 0, and without contact, it is the share at that level. Above the last level it is the
   share at the last level. */
double dynamics_share(const dynamics_inputs *inputs, size_t station, double force);

/* The same for the back flanks, which the mean load does not press; they have levels. Without a
 * shared force it is the share at the force for which the curves were computed. */
double dynamics_back_share(const dynamics_inputs *inputs, size_t station, double force);

#endif
