/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compliance of a whole gear from plane finite elements of one sector. The ring of equal sectors
   decouples into circumferential harmonics (cyclic symmetry, Thomas 1979). All teeth are therefore
   included, and the compliance between two teeth is exactly reciprocal. * The displacement under a
   point load grows without bound as elements are refined, so this local part is left out. Instead,
   the displacement of a loaded tooth is that of the point of its axis below the contact, along the
   line of force (Weber 1949). The approach between that point and the flank belongs to the Hertzian
   contact and is that of a half plane. The difference between a tooth and a half plane is smooth.
   It is computed with pressures wide enough for the elements, and added to the tooth. */
#ifndef STIFFNESS_RING_H
#define STIFFNESS_RING_H

#include "sector.h"

/* ROLLS: number of roll angles between which the compliance is interpolated. PLACES: largest
   distance between coupled teeth, in tooth pitches. */
enum { STIFFNESS_RING_ROLLS = 16, STIFFNESS_RING_PLACES = 5 };

typedef struct stiffness_ring {
    double roll_low, roll_high;
    double roll[STIFFNESS_RING_ROLLS], weight[STIFFNESS_RING_ROLLS];
    double own[STIFFNESS_RING_ROLLS]; /* displacement of the axis below the load, m/N, including
                                         the difference to a half plane */
    double thin[2]; /* difference between tooth and half plane, m/N, near both ends of the flank */
    /* [d][a][b]: displacement of the flank at roll angle b of another tooth under a unit force at
       roll angle a; the other tooth is d pitches away, on the side of the loaded flank, m/N */
    double other[STIFFNESS_RING_PLACES + 1][STIFFNESS_RING_ROLLS][STIFFNESS_RING_ROLLS];
    double turning; /* mean displacement of all teeth at mid-flank under a unit force, caused by
                       rotation of the body, m/N */
    size_t nodes, elements;
    double reciprocity; /* largest relative asymmetry between two points of one flank */
} stiffness_ring;

enum { STIFFNESS_RING_MADE, STIFFNESS_RING_MEMORY, STIFFNESS_RING_SINGULAR };
/* Computes the ring for the gear of the contour, fixed at the rim radius, with about `elements`
   elements per sector. */
int stiffness_ring_make(stiffness_ring *ring, const stiffness_contour *contour, double rim_radius,
                        const stiffness_material *material, size_t elements);

/* Returns the displacement under a unit force at that roll angle, without the approach of a half
   plane between flank and axis. */
double stiffness_ring_own(const stiffness_ring *ring, double roll);
/* Returns the displacement of the flank at roll angle `at` under a unit force at roll angle `load`
   of another tooth, `places` pitches away (not 0). */
double stiffness_ring_other(const stiffness_ring *ring, int places, double load, double at);

#endif
