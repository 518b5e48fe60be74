/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Deviations of the flanks from perfect involutes, as the gear states them: along the normal, over
 * the roll angle of the gear's own flank, and index deviations tooth by tooth; positive where there
 * is more metal. What both flanks of a pair miss is its gap; the least gap of all pairs is the
 * transmission error without load. Lengths in m, angles in rad.
 */
#ifndef STIFFNESS_DEVIATIONS_H
#define STIFFNESS_DEVIATIONS_H

#include <flankfilm/plugin.h>

typedef struct stiffness_deviations {
    size_t points; /* of either profile, linear between them; 0: perfect profiles */
    const double *roll[2], *profile[2];
    size_t teeth[2];
    const double *index[2]; /* NULL: perfect pitch */
} stiffness_deviations;

ff_status stiffness_deviations_read(const ff_host *host, const ff_array *in,
                                    stiffness_deviations *d);

/* Deviation of the flank of gear 0 or 1 at its own roll angle. */
double stiffness_profile_deviation(const stiffness_deviations *d, int gear, double roll);
/* Index deviation of the pair that follows the first one of the hunting period by `number`. */
double stiffness_index_deviation(const stiffness_deviations *d, long number);
/* Mesh cycles after which the same teeth meet again when there are index deviations, else 1. */
size_t stiffness_hunting_period(const stiffness_deviations *d);

/* Finds the roll angles of a gear where the slope of its profile jumps; at most `room` are stored.
   Gives their number. */
size_t stiffness_profile_corners(const stiffness_deviations *d, int gear, double *roll,
                                 size_t room);

#endif
