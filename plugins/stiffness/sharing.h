/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * How the pairs of teeth of one mesh position share the line force (Conry & Seireg 1973): forces
 * f >= 0 that add up to F, gaps w = C f + H(f) + gap - s >= 0, f w = 0, with the compliance C, the
 * Hertzian approach H and the loaded transmission error s.
 */
#ifndef FF_STIFFNESS_SHARING_H
#define FF_STIFFNESS_SHARING_H

#include <stdbool.h>
#include <stddef.h>

enum { FF_MAX_PAIRS = 16 };

/* Approach of a line contact, f (constant - slope ln f). */
typedef struct ff_hertz {
    double constant, slope; /* m/N */
} ff_hertz;

typedef struct ff_contacts {
    size_t count;
    double gap[FF_MAX_PAIRS]; /* before load, m */
    double compliance[FF_MAX_PAIRS][FF_MAX_PAIRS];
    ff_hertz hertz[FF_MAX_PAIRS];
} ff_contacts;

typedef struct ff_sharing {
    double force[FF_MAX_PAIRS]; /* 0: not in contact */
    double unloaded;            /* transmission error without load: the least gap */
    double deflection;          /* s - unloaded */
    double tangent;             /* dF/ds */
    double residual;            /* largest gap of a pair in contact, or overlap of another, over
                                   the deflection */
} ff_sharing;

/* Shares the force, > 0. False: no solution, as a contact would be pressed through its tooth. */
bool ff_share(const ff_contacts *c, double force, ff_sharing *result);

#endif
