/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tooth forces and deflections at several mesh forces, for motions whose mesh force differs from
   the mean. The forces are F (i/3)^2, which include F. The compliance at a mesh position is
   computed once for all forces. */
#ifndef STIFFNESS_LEVELS_H
#define STIFFNESS_LEVELS_H

#include "equilibrium.h"
#include "outputs.h"

enum { STIFFNESS_MOST_LEVELS = 10 };

/* The levels. `error` and `stiffness` have a row per level over the points of the cycle, `teeth`
   (tooth forces) a row per level over the stations. */
typedef struct stiffness_level_rows {
    size_t count;
    double *error, *stiffness, *teeth;
} stiffness_level_rows;

/* Returns the number of levels. Without a line force there is one level, 0. */
size_t stiffness_levels_count(const stiffness_source *source);

/* Computes all levels; `rows` has room for stiffness_levels_count() of them. */
ff_status stiffness_levels_solve(const stiffness_source *source, const stiffness_cycle *cycle,
                                 const stiffness_level_rows *rows);

/* Writes the wanted outputs from STIFFNESS_OUT_FORCE_LEVEL on. `rows` then points to the data of
   the outputs; its count is 0 if none of them is wanted. */
ff_status stiffness_levels_publish(const stiffness_source *source, const stiffness_cycle *cycle,
                                   uint64_t wanted, stiffness_level_rows *rows);

#endif
