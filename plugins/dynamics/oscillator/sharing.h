/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Quality lines about the load sharing of the tooth pairs. With a frozen force they report how far
   the load sharing at the mean load differs from that at the forces of the motion. With a shared
   force they report the error of interpolation between the force levels. */
#ifndef DYNAMICS_SHARING_H
#define DYNAMICS_SHARING_H

#include "../excitation/share.h"

/* Largest changes between the mean force and another force. */
typedef struct dynamics_sharing_change {
    double share, slope; /* change of a pair's load share; relative change of the slope of the
                            mesh */
} dynamics_sharing_change;

/* Returns the changes at `force`, which is limited to the range of the levels above 0. */
dynamics_sharing_change dynamics_sharing_change_at(const dynamics_force_levels *levels, double mean,
                                                   double force);

/* Returns the interpolation error of a shared force, relative to the mean force: the largest change
   of mesh and tooth forces if every second level is left out. The errors of the levels at mesh
   forces from `least` to `largest` (N) are used; beyond the last level, that level is left out too.
   Returns -1 if out of memory. */
double dynamics_level_error(const dynamics_inputs *inputs, double least, double largest);

/* Compares the frozen spring with the mesh between the deflections at the forces `least` and
   `largest` (N): returns by how much the chord of the mesh is steeper than that of the frozen
   spring, relative to the latter, as a mean over the phases. The levels must have errors. A natural
   frequency changes by half of it. Returns NAN if out of memory. */
double dynamics_slope_change(const dynamics_inputs *inputs, int on_chord, double least,
                             double largest);

/* Writes the quality line force_levels of a shared force, or else the lines slope_change and
   sharing_change. `least` and `largest` are the mesh forces of the motion, N. Nothing is written if
   the stiffness gives no levels or the force is constant. `on_chord` as in excitation.h. */
void dynamics_sharing_report(const dynamics_inputs *inputs, int on_chord, double least,
                             double largest, const ff_host *host);

#endif
