/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The known stable periodic motions of a gear pair at one speed, including those that the model
   does not show. */
#ifndef DYNAMICS_STABLE_MOTIONS_H
#define DYNAMICS_STABLE_MOTIONS_H

#include "atlas.h"

#include <flankfilm/plugin.h>

/* A set of different motions, each with its shortest period. All members 0: empty. */
typedef struct dynamics_known_motions {
    dynamics_orbit *orbits;
    size_t count, capacity;
    size_t of_atlas; /* number of motions that only the atlas contains */
} dynamics_known_motions;

/* Adds to the empty set `known` the motions of both branches, of evenly spread starts, and of the
   atlas (NULL: no atlas). Free `known` with dynamics_known_motions_free in any case. */
ff_status dynamics_known_motions_find(const dynamics_flow *flow, double lambda,
                                      const dynamics_atlas *atlas, const ff_host *host,
                                      dynamics_known_motions *known);
void dynamics_known_motions_free(dynamics_known_motions *known);
/* Adds a motion if it is stable and not in the set. Returns 0 if out of memory. */
int dynamics_known_motions_add(const dynamics_flow *flow, const dynamics_orbit *orbit,
                               dynamics_known_motions *known);
/* Adds the stable motions of the atlas at a speed. Returns 0 if out of memory. */
int dynamics_known_motions_add_atlas(const dynamics_flow *flow, const dynamics_atlas *atlas,
                                     double lambda, dynamics_known_motions *known);
/* Finds the motion with the largest rms. Returns 0 if the set is empty. */
int dynamics_known_motions_largest(const dynamics_flow *flow, const dynamics_known_motions *known,
                                   dynamics_orbit *orbit);
/* Writes DYNAMICS_OUT_STABLE_MOTIONS and lists the motions in the quality record. */
ff_status dynamics_known_motions_put(const dynamics_flow *flow, const dynamics_known_motions *known,
                                     const ff_host *host);

/* Finds and writes the stable motions of a model without an atlas. `frequency` is the mesh
   frequency over the natural frequency. */
ff_status dynamics_stable_motions_put(const dynamics_excitation *excitation, double frequency,
                                      const ff_host *host);

#endif
