/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The samples of stiffness/table: from the lists or the file of its parameters, and checked. */
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
    const char *path;          /* NULL: the lists */
    ff_reals phase, stiffness; /* the lists of the YAML file */
    int32_t interpolation, load_share, definition, ends;
    int64_t points;
    double tolerance;
    ff_reals corner; /* phases where the slope of a fit may jump */
    bool *corner_at; /* the same as a flag for each distinct phase */
    const ff_table *file;
    size_t forces;        /* at which the file has the samples; 0: at one, that of the duty */
    size_t count;         /* samples, of the lists or the file */
    const double *at, *k; /* their phases and stiffnesses; k NULL: transmission errors given */
    const double *error, *loaded, *share;
    stiffness_table_phases distinct;
} stiffness_table;

extern const ff_param stiffness_table_columns[STIFFNESS_TABLE_COLUMNS];

/* Finds the samples and their distinct phases, or refuses them where the user finds them. */
ff_status stiffness_table_samples(stiffness_table *t);

#endif
