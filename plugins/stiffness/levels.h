/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tooth forces and deflections at several mesh forces, for motions whose mesh force departs from
 * the mean. The forces are F (i/3)^2, which include F; the compliance of a mesh position is
 * computed once for all of them. */
#ifndef STIFFNESS_LEVELS_H
#define STIFFNESS_LEVELS_H

#include "equilibrium.h"
#include "outputs.h"

/* Gives the wanted outputs from STIFFNESS_OUT_FORCE_LEVEL on. Without a line force there is one
 * level, 0. */
ff_status stiffness_levels_publish(const stiffness_source *source, const stiffness_cycle *cycle,
                                   uint64_t wanted);

#endif
