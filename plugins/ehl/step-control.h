/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time steps as long as their truncation allows, that land on the kinks of the history. */
#ifndef EHL_STEP_CONTROL_H
#define EHL_STEP_CONTROL_H

#include "march.h"

typedef struct ehl_step_control {
    double tolerance;   /* of the film, relative: what a passage through the contact may gather */
    double *breakpoint; /* times to land on; the last is the end */
    size_t breakpoints, next;
    double dt; /* of the next step */
} ehl_step_control;

ff_status ehl_step_control_create(ehl_step_control *p, const ehl_march *m, double tolerance);
void ehl_step_control_destroy(ehl_step_control *p);

/* One step; FF_OK, or FF_NOCONV with m->why. */
ff_status ehl_step_control_next(ehl_step_control *p, ehl_march *m);

int ehl_step_control_done(const ehl_step_control *p);

#endif
