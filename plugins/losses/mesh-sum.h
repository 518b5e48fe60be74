/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loss of one tooth pair along the path of contact, summed over the pairs that are in mesh
 * together. */
#ifndef LOSSES_MESH_SUM_H
#define LOSSES_MESH_SUM_H

#include <stdbool.h>
#include <stddef.h>

/* Loss of a pair (W) over the roll angle (rad), linear between n >= 2 points; `pitch` is the roll
   angle from one pair to the next. */
typedef struct losses_engagement {
    size_t n;
    const double *roll, *loss;
    double pitch;
} losses_engagement;

/* The phase of the mesh cycle at which the pair ahead leaves; 0: when another pair enters. */
double losses_leaving_phase(const losses_engagement *e);

/* Loss of all pairs at a phase of the mesh cycle, from 0 to 1. Where a pair enters or leaves it is
   the limit from above, or with `before` that from below. */
double losses_mesh_loss(const losses_engagement *e, double phase, bool before);

/* Mean over the mesh cycle of the sum over all pairs of a quantity of a pair; exact. */
double losses_mesh_mean(const losses_engagement *e, const double *value);

/* y on the straight line over interval i; beyond its ends it is that at the end. */
double losses_interpolate(const double *x, const double *y, size_t i, double at);

#endif
