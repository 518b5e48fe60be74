/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters and columns of stiffness/table. */
#ifndef STIFFNESS_TABLE_ROWS_H
#define STIFFNESS_TABLE_ROWS_H

#include <flankfilm/plugin.h>

enum {
    FILE_NAME,
    PHASE,
    STIFFNESS,
    INTERPOLATION,
    LOAD_SHARE,
    POINTS,
    DEFINITION,
    TOLERANCE,
    CORNERS,
    ENDS,
    STIFFNESS_TABLE_PARAMS
};
/* In the order of the rows, as the parameters are. */
enum {
    COLUMN_PHASE,
    COLUMN_STIFFNESS,
    COLUMN_ERROR,
    COLUMN_LOADED,
    COLUMN_SHARE,
    STIFFNESS_TABLE_COLUMNS
};
enum { LINEAR, CUBIC, FITTED };
enum { RIGID, FROM_FILE };
enum { SECANT, TANGENT };
enum { PERIODIC, JUMP };

extern const ff_param stiffness_table_params[STIFFNESS_TABLE_PARAMS];
extern const ff_param stiffness_table_columns[STIFFNESS_TABLE_COLUMNS];

#endif
