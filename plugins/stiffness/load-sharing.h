/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load sharing of the pairs of teeth at one mesh position (Conry & Seireg 1973). The forces f >= 0
   sum to the line force F; the separations w = C f + H(f) + gap - s are not negative; and f w = 0
   for each pair. C is the compliance, H the Hertzian approach and s the loaded transmission error.
   Lengths in m, forces in N. */
#ifndef STIFFNESS_LOAD_SHARING_H
#define STIFFNESS_LOAD_SHARING_H

#include <stdbool.h>
#include <stddef.h>

enum { STIFFNESS_MAX_PAIRS = 16 };

/* Approach of a line contact, f (constant - slope ln f). */
typedef struct stiffness_hertz {
    double constant, slope; /* m/N */
} stiffness_hertz;

typedef struct stiffness_contacts {
    size_t count;
    double gap[STIFFNESS_MAX_PAIRS]; /* gap without load, m */
    double compliance[STIFFNESS_MAX_PAIRS][STIFFNESS_MAX_PAIRS];
    stiffness_hertz hertz[STIFFNESS_MAX_PAIRS];
} stiffness_contacts;

typedef struct stiffness_sharing {
    double force[STIFFNESS_MAX_PAIRS]; /* 0: not in contact */
    double unloaded;                   /* transmission error without load: the smallest gap */
    double deflection;                 /* s - unloaded */
    double tangent;                    /* dF/ds */
    double residual; /* relative to the deflection: largest separation of a pair in contact, or
                        largest overlap of another pair */
} stiffness_sharing;

/* Solves the load sharing for a positive force. Returns false if there is no solution because the
   approach of a contact would exceed the depth of its tooth. */
bool stiffness_share(const stiffness_contacts *c, double force, stiffness_sharing *result);
/* Does the same faster, starting from the solution `near` for another force on the same contacts.
   `near` may be NULL. */
bool stiffness_share_near(const stiffness_contacts *c, double force, const stiffness_sharing *near,
                          stiffness_sharing *result);

#endif
