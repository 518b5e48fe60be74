/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of the back flanks, which carry load if the mesh force changes its sign. Their contact
   runs along the mirrored line of action. At the phase x of the driving flanks, back flanks meet at
   the place on gear 1 where driving flanks meet at the phase x_b (theory, eq. 4.5c): * x_b = 2
   phi_P + s_1/p - x (mod 1), * with the mesh cycles phi_P from SAP to the pitch point, and the
   thickness s_1/p of a tooth of gear 1 on the working pitch circle, plus half of the backlash, over
   the pitch. With half of the backlash, gear 2 gives the same phase. */
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

/* Writes the outputs from STIFFNESS_OUT_BACK_PHASE on: the mirrored curves of `flank`. If `flank`
   is NULL, the outputs are empty, which means unknown. */
ff_status stiffness_back_publish(const ff_host *host, const stiffness_gears *gears,
                                 const stiffness_flank *flank, size_t stations);

#endif
