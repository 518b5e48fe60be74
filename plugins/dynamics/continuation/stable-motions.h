/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The known stable periodic motions of a gear pair at one speed, whichever of them a model shows.
 */
#ifndef DYNAMICS_STABLE_MOTIONS_H
#define DYNAMICS_STABLE_MOTIONS_H

#include "atlas.h"

#include <flankfilm/plugin.h>

/* Different motions, each with its shortest period. All 0: none. */
typedef struct dynamics_known_motions {
    dynamics_orbit *orbits;
    size_t count, capacity;
    size_t of_atlas; /* how many of them only the atlas found */
} dynamics_known_motions;

/* Fills `known`, which is empty, with the motions of both branches, of evenly spread starts and of
 * the atlas (NULL: no atlas). dynamics_known_motions_free frees `known` in any case. */
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
/* Gives the motion with the largest rms. 0: there is none. */
int dynamics_known_motions_largest(const dynamics_flow *flow, const dynamics_known_motions *known,
                                   dynamics_orbit *orbit);
/* Gives DYNAMICS_OUT_STABLE_MOTIONS and lists the motions in the quality record. */
ff_status dynamics_known_motions_put(const dynamics_flow *flow, const dynamics_known_motions *known,
                                     const ff_host *host);

/* Finds and gives the motions for a model without an atlas; `frequency` is the mesh frequency over
 * the natural frequency. */
ff_status dynamics_stable_motions_put(const dynamics_excitation *excitation, double frequency,
                                      const ff_host *host);

#endif
