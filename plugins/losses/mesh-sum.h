/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What one tooth pair loses on its way, summed over the pairs that are in mesh together. */
#ifndef LOSSES_MESH_SUM_H
#define LOSSES_MESH_SUM_H

#include <stdbool.h>
#include <stddef.h>

/* Loss of a pair over the roll angle, straight lines between n >= 2 points; `pitch` is the roll
   angle from one pair to the next. */
typedef struct losses_engagement {
    size_t n;
    const double *roll, *loss;
    double pitch;
} losses_engagement;

/* Share of the mesh cycle after which the pair ahead leaves; 0: together with the entry. */
double losses_leaving_phase(const losses_engagement *e);

/* Loss of all pairs at a phase of the mesh cycle, from 0 to 1; before: its limit from below, where
   a pair enters or leaves. */
double losses_mesh_loss(const losses_engagement *e, double phase, bool before);

/* Exact mean over the mesh cycle of any such quantity of a pair. */
double losses_mesh_mean(const losses_engagement *e, const double *value);

/* Rank of the last of n values, which do not decrease, that is <= at, at most n - 2. */
size_t losses_interval(size_t n, const double *x, double at);
double losses_between(const double *x, const double *y, size_t i, double at);

#endif
