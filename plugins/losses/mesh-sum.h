/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loss of one tooth pair along the path of contact, summed over all pairs in mesh. */
#ifndef LOSSES_MESH_SUM_H
#define LOSSES_MESH_SUM_H

#include <stdbool.h>
#include <stddef.h>

/* Loss of a pair (W) over its roll angle (rad), linear between n >= 2 points; `pitch` is the
 * roll angle from one pair to the next. */
typedef struct losses_engagement {
    size_t n;
    const double *roll, *loss;
    double pitch;
} losses_engagement;

/* Returns the phase of the mesh cycle at which the leading pair leaves; 0: it leaves when another
   pair enters. */
double losses_leaving_phase(const losses_engagement *e);

/* Returns the loss of all pairs at a phase of the mesh cycle, from 0 to 1. If a pair enters or
   leaves there, it is the limit from above, or with `before` the limit from below. */
double losses_mesh_loss(const losses_engagement *e, double phase, bool before);

/* Returns the exact mean over the mesh cycle of a quantity summed over all pairs; `value` is the
   quantity of one pair. */
double losses_mesh_mean(const losses_engagement *e, const double *value);

/* Returns y at `at` on the straight line over interval i. Beyond the ends of the interval it is
   constant. */
double losses_interpolate(const double *x, const double *y, size_t i, double at);

#endif
