/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the teeth of a mesh position carry and give way to at several forces, for motions whose mesh
 * force leaves the mean one. The forces are F (i/3)^2, so that F is one of them; the compliance of
 * a position is worked out once.
 */
#ifndef STIFFNESS_LEVELS_H
#define STIFFNESS_LEVELS_H

#include "equilibrium.h"
#include "outputs.h"

/* Gives what is wanted of STIFFNESS_OUT_FORCE_LEVEL and those behind it; without a line force there
   is one level, 0. */
ff_status stiffness_levels_publish(const stiffness_source *source, const stiffness_cycle *cycle,
                                   uint64_t wanted);

#endif
