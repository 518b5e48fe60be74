/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The series that a case of a chain passes to the next case, as warm-start.h does with a state. */
#ifndef DYNAMICS_HARMONICS_WARM_START_H
#define DYNAMICS_HARMONICS_WARM_START_H

#include <flankfilm/plugin.h>

enum { DYNAMICS_MOST_HARMONICS = 512 };

/* The series begins at phase 0 = SAP. */
typedef struct dynamics_harmonics_warm_start {
    char mark[16];
    double mesh_frequency;                     /* Hz */
    uint64_t harmonics;                        /* 0: there is no series */
    double x[2 * DYNAMICS_MOST_HARMONICS + 1]; /* m */
} dynamics_harmonics_warm_start;

/* Converts a series in units of `length` to m and stores it. */
void dynamics_harmonics_warm_start_set(dynamics_harmonics_warm_start *warm_start,
                                       double mesh_frequency, const double *x, size_t harmonics,
                                       double length);

/* Implements `carry` of a model: reads the series of the neighbouring case, or none if the bytes
   have another format, and writes the model's own series. */
ff_status dynamics_harmonics_warm_start_carry(dynamics_harmonics_warm_start *taken,
                                              const ff_state_bytes *from,
                                              const dynamics_harmonics_warm_start *left,
                                              ff_state_bytes *to);

#endif
