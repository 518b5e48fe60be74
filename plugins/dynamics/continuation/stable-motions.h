/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stable periodic motions that are known of a gear pair at one speed, whichever of them a model
 * shows. */
#ifndef DYNAMICS_STABLE_MOTIONS_H
#define DYNAMICS_STABLE_MOTIONS_H

#include "atlas.h"

#include <flankfilm/plugin.h>

/* Different motions, each with its shortest period. All 0: none. */
typedef struct dynamics_known_motions {
    dynamics_orbit *orbits;
    size_t count, capacity;
    size_t of_atlas; /* how many of them the atlas alone knew */
} dynamics_known_motions;

/* Adds to none those that both branches and evenly spread starts lead to, and those of the atlas
   (NULL: none). `known` is freed by dynamics_known_motions_free in any case. */
ff_status dynamics_known_motions_find(const dynamics_flow *flow, double lambda,
                                      const dynamics_atlas *atlas, const ff_host *host,
                                      dynamics_known_motions *known);
void dynamics_known_motions_free(dynamics_known_motions *known);
/* Adds a motion if it is stable and new. 0: out of memory. */
int dynamics_known_motions_add(const dynamics_flow *flow, const dynamics_orbit *orbit,
                               dynamics_known_motions *known);
/* Adds the stable motions of the atlas at a speed. 0: out of memory. */
int dynamics_known_motions_add_atlas(const dynamics_flow *flow, const dynamics_atlas *atlas,
                                     double lambda, dynamics_known_motions *known);
/* The one with the largest rms; 0: there is none. */
int dynamics_known_motions_largest(const dynamics_flow *flow, const dynamics_known_motions *known,
                                   dynamics_orbit *orbit);
/* Gives DYNAMICS_OUT_STABLE_MOTIONS and says in the quality record which they are. */
ff_status dynamics_known_motions_put(const dynamics_flow *flow, const dynamics_known_motions *known,
                                     const ff_host *host);

/* Finds and gives those of a model without an atlas; `frequency` is that of the mesh over the
   natural one. */
ff_status dynamics_stable_motions_put(const dynamics_excitation *excitation, double frequency,
                                      const ff_host *host);

#endif
