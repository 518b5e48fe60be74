/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How many stable periodic motions a gear pair has at one speed, whichever of them a model shows.
 */
#ifndef DYNAMICS_STABLE_MOTIONS_H
#define DYNAMICS_STABLE_MOTIONS_H

#include "excitation.h"

#include <flankfilm/plugin.h>

/* Gives DYNAMICS_OUT_STABLE_MOTIONS and says in the quality record which they are; `frequency` is
   that of the mesh over the natural one. */
ff_status dynamics_stable_motions_put(const dynamics_excitation *excitation, double frequency,
                                      const ff_host *host);

#endif
