/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time steps as long as their truncation allows, that land on the kinks of the history. */
#ifndef EHL_PACE_H
#define EHL_PACE_H

#include "march.h"

typedef struct ehl_pace {
    double tolerance; /* of the film, relative: what a passage through the contact may gather */
    double *knot;     /* times to land on; the last is the end */
    size_t knots, next;
    double dt; /* of the next step */
} ehl_pace;

ff_status ehl_pace_create(ehl_pace *p, const ehl_march *m, double tolerance);
void ehl_pace_destroy(ehl_pace *p);

/* One step; FF_OK, or FF_NOCONV with m->why. */
ff_status ehl_pace_next(ehl_pace *p, ehl_march *m);

int ehl_pace_done(const ehl_pace *p);

#endif
