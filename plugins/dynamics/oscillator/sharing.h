/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Quality lines about the load sharing of the tooth pairs. If the force is frozen, they report how
   much the load sharing at the mean load differs from that at the forces of the motion. If it is
   shared, they report the error of interpolation between the force levels. */
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
   of mesh and tooth forces if every second level is left out. The errors at mesh forces from
   `least` to `largest` (N) are used; for forces beyond the last level, the last level is left out
   too. Returns -1 if out of memory. */
double dynamics_level_error(const dynamics_inputs *inputs, double least, double largest);

/* Compares the frozen spring with the mesh between the deflections at the forces `least` and
   `largest` (N): returns the secant stiffness of the mesh minus that of the frozen spring, relative
   to that of the frozen spring, as a mean over the phases. The levels must contain transmission
   errors. Natural frequencies change by half of this value. Returns NAN if out of memory. */
double dynamics_slope_change(const dynamics_inputs *inputs, int on_chord, double least,
                             double largest);

/* Writes the quality line force_levels of a shared force, or else the lines slope_change and
   sharing_change. `least` and `largest` are the mesh forces of the motion, N. Nothing is written if
   the stiffness gives no levels or the force is constant. `on_chord`: see excitation.h. */
void dynamics_sharing_report(const dynamics_inputs *inputs, int on_chord, double least,
                             double largest, const ff_host *host);

#endif
