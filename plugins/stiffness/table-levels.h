/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A table at several mesh forces. The rows of each force are consecutive, every force has the same
   phases, and the first force is 0. At each phase, the transmission error between the forces is the
   monotone cubic of Steffen 1990. */
#ifndef STIFFNESS_TABLE_LEVELS_H
#define STIFFNESS_TABLE_LEVELS_H

#include "table-samples.h"

/* The largest number of forces in a table. */
enum { STIFFNESS_TABLE_FORCES = 24 };

/* The forces of a table and the line force, as rows over the phases of the table. */
typedef struct stiffness_table_levels {
    size_t count, mean; /* mean: index of the row of the line force */
    double force[STIFFNESS_TABLE_FORCES + 1];
    double *error, *slope; /* error, m, and slope dF/d(error), N/m */
    double *share;         /* load share of the pair that entered last; NULL: equal shares */
} stiffness_table_levels;

/* Checks the rows of a file with the column force. Sets the samples of `table` to those of force 0,
   and `loaded` to those of the last force. */
ff_status stiffness_table_levels_check(stiffness_table *table);

/* Computes the levels. Returns FF_INVALID if the table does not reach the line force. The caller
   frees the levels, also after an error. */
ff_status stiffness_table_levels_make(const stiffness_table *table, double line_force,
                                      stiffness_table_levels *levels);
void stiffness_table_levels_free(stiffness_table_levels *levels);

#endif
