/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stable motions of a pair on its bearings that repeat themselves after one mesh cycle, by Newton's
 * method, and how they change with the speed. */
#ifndef DYNAMICS_COUPLED_SHOOTING_H
#define DYNAMICS_COUPLED_SHOOTING_H

#include "../oscillator/settle.h"
#include "coupled-run.h"

/* A motion at a mesh frequency (relative to the natural one), and what finding it took. */
typedef struct dynamics_coupled_orbit {
    double frequency;
    double state[DYNAMICS_TAKEN]; /* at phase 0 */
    double distance;              /* of the state before the last correction */
    int touches;                  /* the driving flanks never part, the back flanks never meet */
    size_t cycles;                /* integrated so far; not reset */
} dynamics_coupled_orbit;

/* Looks for the stable motion near orbit->state, which is moved there; `far` is the longest way to
   it. FF_NOCONV: there is none nearby. */
ff_status dynamics_coupled_shoot(dynamics_coupled_run *run, double far, double tolerance,
                                 const ff_host *host, dynamics_coupled_orbit *orbit);

/* Follows a stable motion to another frequency, where it is found to 1e-3. FF_NOCONV: it ends on
   the way, and `orbit` is the last that was found. */
ff_status dynamics_coupled_follow(dynamics_coupled_run *run, double to, const ff_host *host,
                                  dynamics_coupled_orbit *orbit);

/* The Floquet multipliers of a monodromy as pairs (re, im), and the largest modulus. */
ff_status dynamics_coupled_multipliers(const double *monodromy, double *multipliers,
                                       double *largest);

#endif
