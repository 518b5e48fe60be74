/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Curves of the back flanks, which carry load if the mesh force changes its sign. Their contact
 * runs along the mirrored line of action. At the phase x of the driving flanks, back flanks meet at
 * the place on gear 1 where driving flanks meet at the phase x_b (theory, eq. 4.5c):
 *
 *   x_b = 2 phi_P + s_1/p - x  (mod 1),
 *
 * phi_P mesh cycles from SAP to the pitch point, s_1/p the thickness of gear 1 on the working pitch
 * circle over the pitch. Gear 2 gives the same phase: the rest of the pitch is divided between both
 * gears.
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

/* Writes the outputs from STIFFNESS_OUT_BACK_PHASE on: the mirrored curves of `flank`. If it is
 * NULL, the flank is not known and the outputs are empty. */
ff_status stiffness_back_publish(const ff_host *host, const stiffness_gears *gears,
                                 const stiffness_flank *flank, size_t stations);

#endif
