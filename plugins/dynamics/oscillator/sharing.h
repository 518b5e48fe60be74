/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the lines say of how the pairs share the mesh force of an instant: how far the sharing of
   the mean load is from that of the forces that the motion reaches where it is frozen, and how far
   the levels of the force are apart where it is not. */
#ifndef DYNAMICS_SHARING_H
#define DYNAMICS_SHARING_H

#include "../excitation/share.h"

/* Largest changes between the mean force and another one. */
typedef struct dynamics_sharing_change {
    double share, slope; /* of the share of a pair; of the slope of the mesh, over that slope */
} dynamics_sharing_change;

/* The force is held within the levels above 0. */
dynamics_sharing_change dynamics_sharing_change_at(const dynamics_force_levels *levels, double mean,
                                                   double force);

/* Of a shared force, over the mean force: by how much the mesh force at the errors of its levels
   from `least` to `largest`, N, and the tooth forces there, change when every second level is left
   out; beyond the last level, that one, too. -1: out of memory. */
double dynamics_level_error(const dynamics_inputs *inputs, double least, double largest);

/* Of a frozen force: by how much the chord of the mesh between its errors at the forces `least` and
   `largest`, N, is steeper than that of the frozen spring between the same errors, on the mean over
   the phases; the levels have errors. A natural frequency changes by half of it. NAN: out of
   memory. */
double dynamics_slope_change(const dynamics_inputs *inputs, int on_chord, double least,
                             double largest);

/* The line force_levels of a shared force; else the lines slope_change and sharing_change, by the
   least and the largest mesh force of the motion, N; none where the stiffness does not know its
   levels or the force is constant. `on_chord` as in excitation.h. */
void dynamics_sharing_report(const dynamics_inputs *inputs, int on_chord, double least,
                             double largest, const ff_host *host);

#endif
