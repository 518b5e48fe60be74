/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters, inputs and columns of stiffness/table. */
#ifndef FF_STIFFNESS_TABLE_ROWS_H
#define FF_STIFFNESS_TABLE_ROWS_H

#include "mesh.h"

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
    FF_TABLE_PARAMS
};
enum {
    COLUMN_PHASE,
    COLUMN_STIFFNESS,
    COLUMN_ERROR,
    COLUMN_LOADED,
    COLUMN_SHARE,
    FF_TABLE_COLUMNS
};
enum { LINEAR, CUBIC, FITTED };
enum { RIGID, FROM_FILE };
enum { SECANT, TANGENT };
enum { PERIODIC, JUMP };

extern const ff_param ff_table_params[FF_TABLE_PARAMS];
extern const ff_param ff_table_columns[FF_TABLE_COLUMNS];
extern const ff_port ff_table_inputs[FF_MESH_INPUTS];

#endif
