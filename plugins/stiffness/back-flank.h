/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The flanks that the mean load does not press, which bear where the mesh force changes its sign.
 * Their contact runs along the mirrored line of action. Back flanks meet at that place of gear 1 at
 * which driving flanks meet at the phase x_b, when the driving flanks are at the phase x (theory,
 * eq. 4.5c):
 *
 *   x_b = 2 phi_P + s_1/p - x  (mod 1),
 *
 * phi_P mesh cycles from SAP to the pitch point, s_1/p the thickness of gear 1 on the working pitch
 * circle over the pitch. What both gears leave of the pitch is shared between them, so that gear 2
 * gives the same phase.
 */
#ifndef STIFFNESS_BACK_FLANK_H
#define STIFFNESS_BACK_FLANK_H

#include "equilibrium.h"
#include "levels.h"

/* Curves of one flank over its own mesh cycle. */
typedef struct stiffness_flank {
    const stiffness_cycle *cycle;
    const double *stiffness, *error, *loaded;
    stiffness_level_rows levels;
} stiffness_flank;

/* Returns 2 phi_P + s_1/p in [0, 1). */
double stiffness_back_offset(const stiffness_gears *gears);

/* Gives the outputs from STIFFNESS_OUT_BACK_PHASE on: `flank`, mirrored. NULL: the flank is not
 * known, and the outputs are empty. */
ff_status stiffness_back_publish(const ff_host *host, const stiffness_gears *gears,
                                 const stiffness_flank *flank, size_t stations);

#endif
