/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses time steps as long as their truncation errors allow. Steps end at each breakpoint of the
   history. */
#ifndef EHL_STEP_CONTROL_H
#define EHL_STEP_CONTROL_H

#include "../equations/march.h"

typedef struct ehl_step_control {
    double tolerance;   /* relative error of the film that may accumulate in one passage through
                           the contact */
    double *breakpoint; /* times at which a step must end, s; the last one is the end of the
                           history */
    size_t breakpoints, next;
    double dt;        /* s, length of the next step */
    int futile, calm; /* steps that were shortened in vain; steps since the last of them */
} ehl_step_control;

/* Makes a step control. `equal`: the step lengths are given, and only kinks of the radius are
   breakpoints. */
ff_status ehl_step_control_create(ehl_step_control *p, const ehl_march *m, double tolerance,
                                  int equal);
void ehl_step_control_destroy(ehl_step_control *p);

/* Takes one step. Returns FF_OK, or FF_NOCONV with the reason in m->why. */
ff_status ehl_step_control_next(ehl_step_control *p, ehl_march *m);

/* Advances to `time` in one step, or in several that end at the breakpoints on the way. */
ff_status ehl_step_control_to(ehl_step_control *p, ehl_march *m, double time);

int ehl_step_control_done(const ehl_step_control *p);

#endif
