/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Deviations of the flanks from perfect involutes, given by the gear stage: along the normal over
   the flank's own roll angle, and index deviations of single teeth; positive where there is more
   metal. The gap of a pair is minus the sum of the deviations of both flanks. The smallest gap of
   all pairs is the transmission error without load. Lengths in m, angles in rad. */
#ifndef STIFFNESS_DEVIATIONS_H
#define STIFFNESS_DEVIATIONS_H

#include <flankfilm/plugin.h>

#include <stdbool.h>

typedef struct stiffness_deviations {
    size_t points; /* points of each profile, linear between them; 0: perfect profiles */
    const double *roll[2], *profile[2];
    size_t teeth[2];
    const double *index[2]; /* NULL: perfect pitch */
} stiffness_deviations;

ff_status stiffness_deviations_read(const ff_host *host, const ff_array *in,
                                    stiffness_deviations *d);

/* Reads the profiles of the back flanks, without index deviations, which are not known. Sets `same`
   if the profiles equal those of the driving flanks, `d`. */
ff_status stiffness_deviations_read_back(const ff_host *host, const ff_array *in,
                                         const stiffness_deviations *d, stiffness_deviations *back,
                                         bool *same);

/* Returns the deviation of the flank of gear 0 or 1 at its own roll angle. */
double stiffness_profile_deviation(const stiffness_deviations *d, int gear, double roll);
/* Returns the index deviation of the pair number `number`, counted from the first pair of the
   hunting period. */
double stiffness_index_deviation(const stiffness_deviations *d, long number);
/* Returns the hunting period: the number of mesh cycles after which the same teeth meet again; 1
   without index deviations. */
size_t stiffness_hunting_period(const stiffness_deviations *d);

/* Finds the roll angles at which the slope of a gear's profile jumps, and stores up to `room` of
   them. Returns their number. */
size_t stiffness_profile_corners(const stiffness_deviations *d, int gear, double *roll,
                                 size_t room);

#endif
