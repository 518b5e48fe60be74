/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A gear pair whose gears turn and move on their bearings. Coordinates are
 *
 *   q        rb1 theta1 + rb2 theta2, what the rotations bring the driving flanks together,
 *   x1, y1   displacement of gear 1 along the line of centres, towards gear 2, and across it,
 *   x2, y2   the same of gear 2,
 *
 * in the units of mesh.h. The rotation of the pair as a rigid body is left out: nothing holds it.
 * With s = q - (rb1 + rb2) psi, where psi is the turn of the line of centres, the driving flanks
 * overlap by s - e - b and the back flanks by e - s - b. The half backlash b, the pressure angle
 * and the ends of contact follow the distance of the centres. The force of a flank acts along its
 * line of action, so that it is the gradient of the overlap.
 */
#ifndef FF_DYNAMICS_COUPLED_PAIR_H
#define FF_DYNAMICS_COUPLED_PAIR_H

#include "mesh.h"

enum { FF_Q, FF_X1, FF_Y1, FF_X2, FF_Y2, FF_COORDINATES };

typedef struct ff_coupled {
    const ff_mesh *mesh;
    double mass[2];                   /* over the equivalent mass */
    double bearing[2], damper[2];     /* stiffness and damping coefficient of the bearings */
    double base, centre, line, angle; /* rb1 + rb2, centre distance, length of the line of action
                                         between the base circles, pressure angle; mounted */
    double base_1, base_pitch;
    size_t nodes;                   /* of the stiffness of one tooth pair */
    double *cycle, *pair_stiffness; /* over mesh cycles behind SAP */
} ff_coupled;

/* What follows from the position of the centres. */
typedef struct ff_place {
    double centre, turn, angle, half_gap;
    double shift;       /* of the contact on gear 1, mesh cycles */
    double entry, exit; /* of a tooth pair, mesh cycles behind SAP; the contact ratio between */
} ff_place;

void ff_coupled_locate(const ff_coupled *pair, const double *position, ff_place *place);

/* Tooth pairs that have been in mesh for phase + j cycles, from the youngest j to the oldest. */
typedef struct ff_pairs {
    int youngest, oldest;
} ff_pairs;

/* In contact at a phase. */
ff_pairs ff_coupled_pairs(const ff_place *place, double phase);
/* The same of the mounted pair, whose stiffness the mesh holds. */
ff_pairs ff_coupled_mounted_pairs(const ff_coupled *pair, double phase);

/* What the change of the place adds to the mesh stiffness. */
double ff_coupled_stiffness_change(const ff_coupled *pair, const ff_place *place, double phase,
                                   ff_pairs now, ff_pairs mounted);

/* Overlap of the flanks of one side (1: driving, -1: back) or s - e (0), and its rate. */
typedef struct ff_overlap {
    double value, rate, gradient[FF_COORDINATES];
} ff_overlap;

ff_overlap ff_coupled_overlap(const ff_coupled *pair, const ff_place *place, int side,
                              const double *position, const double *velocity, double e,
                              double e_rate);

/* Static deflection at phase 0: coordinates and rates. */
void ff_coupled_rest(const ff_coupled *pair, double *state);

/* Fills the stiffness of one tooth pair from its share at the stations, which lie `cycle` mesh
   cycles behind SAP; no share: the contact ratio changes nothing. 0: out of memory. */
int ff_coupled_pair_stiffness(ff_coupled *pair, size_t stations, const double *cycle,
                              const double *share);
void ff_coupled_free(ff_coupled *pair);

#endif
