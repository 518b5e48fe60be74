/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Compliance of a whole gear from plane finite elements of one of its sectors. The ring of equal
 * sectors decouples into circumferential harmonics (cyclic symmetry, Thomas 1979): all teeth are
 * there, and the compliance between two teeth is exactly reciprocal.
 *
 * The displacement under a point load grows without bound as the elements are refined. That local
 * part is left out: under its own load a tooth is displaced as the point of its axis below the
 * contact is, along the line of force (Weber 1949). The approach between that point and the flank
 * belongs to the Hertzian contact and is that of a half plane. A tooth differs from a half plane;
 * the difference is smooth, is found with pressures wide enough for the elements, and is added to
 * the tooth.
 */
#ifndef STIFFNESS_RING_H
#define STIFFNESS_RING_H

#include "sector.h"

/* Compliance is interpolated between that many roll angles; teeth that far apart are coupled. */
enum { STIFFNESS_RING_ROLLS = 16, STIFFNESS_RING_PLACES = 5 };

typedef struct stiffness_ring {
    double roll_low, roll_high;
    double roll[STIFFNESS_RING_ROLLS], weight[STIFFNESS_RING_ROLLS];
    double
        own[STIFFNESS_RING_ROLLS]; /* m/N, at the axis under the load, with the difference below */
    double thin[2];                /* of tooth and half plane, m/N, near both ends of the flank */
    /* [d][a][b]: the flank at b of the tooth d places on towards the loaded flank's side, when the
       tooth is loaded at a */
    double other[STIFFNESS_RING_PLACES + 1][STIFFNESS_RING_ROLLS][STIFFNESS_RING_ROLLS];
    double turning; /* mean displacement of all teeth: turning of the body, in the flank's middle */
    size_t nodes, elements;
    double reciprocity; /* largest relative difference of both ways between points of one flank */
} stiffness_ring;

enum { STIFFNESS_RING_MADE, STIFFNESS_RING_MEMORY, STIFFNESS_RING_SINGULAR };
/* The contour's gear, held at the rim radius, of about `elements` elements per sector. */
int stiffness_ring_make(stiffness_ring *ring, const stiffness_contour *contour, double rim_radius,
                        const stiffness_material *material, size_t elements);

/* Displacement under a unit force at that roll angle without the approach of a half plane between
   flank and axis. */
double stiffness_ring_own(const stiffness_ring *ring, double roll);
/* Displacement of the flank at roll angle `at` of the tooth `places` further on, places not 0,
   under a unit force at roll angle `load`. */
double stiffness_ring_other(const stiffness_ring *ring, int places, double load, double at);

#endif
