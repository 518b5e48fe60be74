/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time steps as long as their truncation allows, that land on the kinks of the history. */
#ifndef FF_EHL_PACE_H
#define FF_EHL_PACE_H

#include "march.h"

typedef struct ff_pace {
    double tolerance; /* of the film, relative: what a passage through the contact may gather */
    double *knot;     /* times to land on; the last is the end */
    size_t knots, next;
    double dt; /* of the next step */
} ff_pace;

ff_status ff_pace_create(ff_pace *p, const ff_march *m, double tolerance);
void ff_pace_destroy(ff_pace *p);

/* One step; FF_OK, or FF_NOCONV with m->why. */
ff_status ff_pace_next(ff_pace *p, ff_march *m);

int ff_pace_done(const ff_pace *p);

#endif
