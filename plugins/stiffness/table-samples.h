/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples of stiffness/table, read from lists or a file and checked. */
#ifndef STIFFNESS_TABLE_SAMPLES_H
#define STIFFNESS_TABLE_SAMPLES_H

#include "interpolation.h"

#include <flankfilm/table.h>

/* In the order of the rows. */
enum {
    COLUMN_PHASE,
    COLUMN_STIFFNESS,
    COLUMN_ERROR,
    COLUMN_LOADED,
    COLUMN_SHARE,
    COLUMN_FORCE,
    COLUMN_TORQUE,
    STIFFNESS_TABLE_COLUMNS
};
enum { LINEAR, CUBIC, FITTED };
enum { RIGID, FROM_FILE };
enum { SECANT, TANGENT };
enum { PERIODIC, JUMP };

extern const ff_param stiffness_table_columns[STIFFNESS_TABLE_COLUMNS];

typedef struct stiffness_table {
    const ff_host *host;
    const char *path;          /* NULL: the lists are used */
    ff_reals phase, stiffness; /* the lists of the YAML file */
    int32_t interpolation, load_share, definition, ends;
    int64_t points;
    double tolerance;
    ff_reals corner; /* phases at which the slope of a fit may jump */
    bool *corner_at; /* the corners as a flag for each distinct phase */
    const ff_table *file;
    size_t forces; /* number of forces in the file; 0: no column force, the errors are those under
                      the line force */
    size_t count;  /* number of samples, in the lists or the file */
    const double *at, *k; /* phases and stiffnesses of the samples; k NULL: transmission errors are
                             given instead */
    const double *error, *loaded, *share;
    stiffness_table_phases distinct;
} stiffness_table;

extern const ff_param stiffness_table_columns[STIFFNESS_TABLE_COLUMNS];

/* Finds the samples and their distinct phases. Refuses an invalid sample, with its position in the
   file. */
ff_status stiffness_table_samples(stiffness_table *t);

#endif
