/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stable periodic motions that are known of a gear pair at one speed, whichever of them a model
 * shows. */
#ifndef DYNAMICS_STABLE_MOTIONS_H
#define DYNAMICS_STABLE_MOTIONS_H

#include "atlas.h"

#include <flankfilm/plugin.h>

enum { DYNAMICS_MOST_KNOWN = 64 };

/* Different motions, each with its shortest period. */
typedef struct dynamics_known_motions {
    dynamics_orbit orbits[DYNAMICS_MOST_KNOWN];
    size_t count;
} dynamics_known_motions;

/* Those that both branches and evenly spread starts lead to, and those of the atlas (NULL: none).
 */
ff_status dynamics_known_motions_find(const dynamics_flow *flow, double lambda,
                                      const dynamics_atlas *atlas, const ff_host *host,
                                      dynamics_known_motions *known);
/* Adds a motion if it is stable and new. */
void dynamics_known_motions_add(const dynamics_flow *flow, const dynamics_orbit *orbit,
                                dynamics_known_motions *known);
/* The one with the largest rms; 0: there is none. */
int dynamics_known_motions_largest(const dynamics_flow *flow, const dynamics_known_motions *known,
                                   dynamics_orbit *orbit);

/* Gives DYNAMICS_OUT_STABLE_MOTIONS and says in the quality record which they are; `frequency` is
   that of the mesh over the natural one. */
ff_status dynamics_stable_motions_put(const dynamics_excitation *excitation, double frequency,
                                      const dynamics_atlas *atlas, const ff_host *host);

#endif
