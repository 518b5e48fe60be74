/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The samples of stiffness/table: from the lists or the file of its parameters, and checked. */
#ifndef STIFFNESS_TABLE_SAMPLES_H
#define STIFFNESS_TABLE_SAMPLES_H

#include "interpolation.h"

#include <flankfilm/table.h>

typedef struct stiffness_table {
    const ff_host *host;
    char *path;
    size_t phases, stiffnesses;
    double *phase, *stiffness; /* the lists of the YAML file */
    int interpolation, load_share, definition, ends;
    size_t points;
    double tolerance;
    size_t corners;
    double *corner;  /* phases where the slope of a fit may jump */
    bool *corner_at; /* the same as a flag for each distinct phase */
    const ff_table *file;
    size_t count;         /* samples, of the lists or the file */
    const double *at, *k; /* their phases and stiffnesses; k NULL: transmission errors given */
    const double *error, *loaded, *share;
    stiffness_table_phases distinct;
} stiffness_table;

/* Finds the samples and their distinct phases, or refuses them where the user finds them. */
ff_status stiffness_table_samples(stiffness_table *t);

#endif
