/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The load sharing of the tooth pairs at a given mesh force. */
#ifndef DYNAMICS_SHARE_H
#define DYNAMICS_SHARE_H

#include "inputs.h"

/* A subset of the force levels of a stiffness: the indices `kept`, or all levels if `kept` is
   NULL. */
typedef struct dynamics_chosen_levels {
    const dynamics_force_levels *of;
    const size_t *kept;
    size_t count;
} dynamics_chosen_levels;

/* Returns the tooth force at a station, N, interpolated between force levels. If a further pair
   comes into contact between two levels, the curve has a kink there. It is approximated by
   extending the lines of the neighbouring intervals up to their intersection. If these lines do not
   intersect in the interval, the straight line between the two levels is used. The kinks of all
   pairs are at the same force, so that the tooth forces sum to the mesh force. */
double dynamics_tooth_force(const dynamics_chosen_levels *levels, double force, size_t station);

/* Returns the load share of the pair at a station under a mesh force, N. If the force is frozen,
   this is the share at the mean force: W_d = (W_s/F) DMF (Li & Kahraman 2011, eq. 5). If it is
   shared, the share is that of dynamics_tooth_force, so that the shares of all pairs sum to 1.
   Below the first level above 0, and without contact, the share is that of this level; above the
   last level, that of the last level. */
double dynamics_share(const dynamics_inputs *inputs, size_t station, double force);

/* Does the same for the back flanks, which must have levels. If the force is not shared, the share
   is that at the force for which the curves were computed. */
double dynamics_back_share(const dynamics_inputs *inputs, size_t station, double force);

#endif
