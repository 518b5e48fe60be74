/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tooth forces and deflections at several mesh forces, for motions whose mesh force departs from
 * the mean. The forces are F (i/3)^2, which include F; the compliance of a mesh position is
 * computed once for all of them. */
#ifndef STIFFNESS_LEVELS_H
#define STIFFNESS_LEVELS_H

#include "equilibrium.h"
#include "outputs.h"

enum { STIFFNESS_MOST_LEVELS = 10 };

/* Rows over the points of a cycle, and over the stations. */
typedef struct stiffness_level_rows {
    size_t count;
    double *error, *stiffness, *teeth;
} stiffness_level_rows;

/* Returns how many levels there are; without a line force one, 0. */
size_t stiffness_levels_count(const stiffness_source *source);

/* Fills rows of that many levels. */
ff_status stiffness_levels_solve(const stiffness_source *source, const stiffness_cycle *cycle,
                                 const stiffness_level_rows *rows);

/* Gives the wanted outputs from STIFFNESS_OUT_FORCE_LEVEL on, and `rows`, which are those of the
 * outputs; count 0: none are wanted. */
ff_status stiffness_levels_publish(const stiffness_source *source, const stiffness_cycle *cycle,
                                   uint64_t wanted, stiffness_level_rows *rows);

#endif
