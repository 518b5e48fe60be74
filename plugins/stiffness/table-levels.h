/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A table at several mesh forces: rows of one force behind each other, each force at the same
 * phases, the first force 0. Between the forces the transmission error is the monotone cubic of
 * Steffen 1990 at each phase.
 */
#ifndef STIFFNESS_TABLE_LEVELS_H
#define STIFFNESS_TABLE_LEVELS_H

#include "table-samples.h"

/* The most forces of a table. */
enum { STIFFNESS_TABLE_FORCES = 24 };

/* The forces of a table and the line force, in rows over the phases of the table. */
typedef struct stiffness_table_levels {
    size_t count, mean; /* mean: the row of the line force */
    double force[STIFFNESS_TABLE_FORCES + 1];
    double *error, *slope; /* m; dF/d(error), N/m */
    double *share;         /* of the pair that entered last; NULL: rigid */
} stiffness_table_levels;

/* Checks the rows of a file with the column force, and sets the samples of `table` to those of the
   force 0, and `loaded` to those of the last one. */
ff_status stiffness_table_levels_check(stiffness_table *table);

/* FF_INVALID: the table does not reach the line force. To be freed in any case. */
ff_status stiffness_table_levels_make(const stiffness_table *table, double line_force,
                                      stiffness_table_levels *levels);
void stiffness_table_levels_free(stiffness_table_levels *levels);

#endif
