/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A gear pair whose gears rotate and move on elastic bearings. The coordinates are
 *   q        rb1 theta1 + rb2 theta2, approach of the driving flanks from the rotations
 *   x1, y1   displacement of gear 1 along the line of centres (towards gear 2) and across it
 *   x2, y2   displacement of gear 2 along the same directions
 * in the units of excitation.h (Kim, Yoo & Chung 2010, J. Sound Vib. 329, 4409-4421). The rotation
 * of the pair as a rigid body is not a coordinate: no spring opposes it. psi is the rotation of the
 * line of centres. With s = q - (rb1 + rb2) psi the driving flanks overlap by s - e - b and the
 * back flanks by e - s - b. The half backlash b, the pressure angle and the ends of contact depend
 * on the centre distance. The force of a flank acts along its line of action, which is the
 * direction of the gradient of the overlap.
 */
#ifndef DYNAMICS_COUPLED_PAIR_H
#define DYNAMICS_COUPLED_PAIR_H

#include "../excitation/excitation.h"

enum { DYNAMICS_Q, DYNAMICS_X1, DYNAMICS_Y1, DYNAMICS_X2, DYNAMICS_Y2, DYNAMICS_COORDINATES };

typedef struct dynamics_coupled {
    const dynamics_excitation *excitation;
    double mass[2];               /* mass of each gear over the equivalent mass */
    double bearing[2], damper[2]; /* stiffness and damping coefficient of the bearings of
                                     each gear */
    /* data of the mounted pair: rb1 + rb2, centre distance, length of the line of action between
       the base circles, pressure angle */
    double base, centre, line, angle;
    double base_1, base_pitch;      /* rb1, base pitch */
    double *cycle, *pair_stiffness; /* mesh cycles after SAP, and the stiffness of one tooth pair
                                       there */
    size_t nodes;                   /* number of these points */
    dynamics_excitation table;      /* excitation whose k is `pair_stiffness` as a function of
                                       `cycle` */
} dynamics_coupled;

/* The contact at the current position of the centres. */
typedef struct dynamics_place {
    double centre, turn, angle, half_gap;
    double sin_turn, cos_turn, sin_angle, cos_angle;
    double shift;       /* shift of the contact along gear 1, mesh cycles */
    double entry, exit; /* entry and exit of a tooth pair, mesh cycles after SAP; their distance is
                           the contact ratio */
} dynamics_place;

void dynamics_coupled_locate(const dynamics_coupled *pair, const double *position,
                             dynamics_place *place);

/* Tooth pairs in mesh. Pair j has been in mesh for phase + j cycles; the youngest pair has the
   smallest j. */
typedef struct dynamics_pairs {
    int youngest, oldest;
} dynamics_pairs;

/* Returns the pairs in contact at a phase. */
dynamics_pairs dynamics_coupled_pairs(const dynamics_place *place, double phase);
/* Returns the pairs in contact if the centres are not displaced. Their stiffnesses sum to the given
   mesh stiffness. */
dynamics_pairs dynamics_coupled_mounted_pairs(const dynamics_coupled *pair, double phase);

/* Returns the change of the mesh stiffness due to the displacement of the centres. */
double dynamics_coupled_stiffness_change(const dynamics_coupled *pair, const dynamics_place *place,
                                         double phase, dynamics_pairs now, dynamics_pairs mounted);

/* Overlap of the flanks of one side (1: driving, -1: back), or s - e for side 0, with its rate and
   its gradient with respect to the coordinates. */
typedef struct dynamics_overlap {
    double value, rate, gradient[DYNAMICS_COORDINATES];
} dynamics_overlap;

dynamics_overlap dynamics_coupled_overlap(const dynamics_coupled *pair, const dynamics_place *place,
                                          int side, const double *position, const double *velocity,
                                          double e, double e_rate);

/* Second derivatives of an overlap. It depends on the centres' coordinates only through their
   difference: along the line of centres (x) and across it (y). */
typedef struct dynamics_bend {
    double xx, xy, yy;
} dynamics_bend;

dynamics_bend dynamics_coupled_bend(const dynamics_place *place, int side);
/* Multiplies the matrix of second derivatives by a change of the coordinates. */
void dynamics_bend_apply(const dynamics_bend *bend, const double *change, double *product);

/* Computes the derivatives of place.shift and place.entry (NULL: not requested) with respect to the
   coordinates. */
void dynamics_coupled_shift_slope(const dynamics_coupled *pair, const dynamics_place *place,
                                  double *shift, double *entry);
/* Returns the derivative of dynamics_coupled_stiffness_change with respect to place.shift. */
double dynamics_coupled_stiffness_slope(const dynamics_coupled *pair, const dynamics_place *place,
                                        double phase, dynamics_pairs now);

/* Computes the static deflection at phase 0: the coordinates, and rates of 0. */
void dynamics_coupled_rest(const dynamics_coupled *pair, double *state);

/* Computes the stiffness of one tooth pair from its load share at the stations, which are at
   `cycle` mesh cycles after SAP. If `share` is NULL, the contact ratio does not affect the
   stiffness. Returns 0 if out of memory. */
int dynamics_coupled_pair_stiffness(dynamics_coupled *pair, size_t stations, const double *cycle,
                                    const double *share);
void dynamics_coupled_free(dynamics_coupled *pair);

#endif
