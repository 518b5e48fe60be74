/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stable motions of a pair on its bearings that repeat themselves after one or some mesh cycles, by
 * Newton's method, and how they change with the speed. */
#ifndef DYNAMICS_COUPLED_SHOOTING_H
#define DYNAMICS_COUPLED_SHOOTING_H

#include "../oscillator/settle.h"
#include "coupled-run.h"

/* A motion at a mesh frequency (relative to the natural one), and what finding it took. */
typedef struct dynamics_coupled_orbit {
    double frequency;
    int period;                   /* mesh cycles */
    double state[DYNAMICS_TAKEN]; /* at phase 0 */
    double distance;              /* of the state before the last correction */
    double largest;               /* multiplier; 0: no motion was found */
    int touches;                  /* the driving flanks never part, the back flanks never meet */
    size_t cycles;                /* integrated so far; not reset */
} dynamics_coupled_orbit;

/* Looks for the stable motion near orbit->state, which is moved there; `far` is the longest way to
   it. FF_NOCONV: there is none nearby, or one that is not stable, whose largest multiplier is set.
 */
ff_status dynamics_coupled_shoot(dynamics_coupled_run *run, double far, double tolerance,
                                 const ff_host *host, dynamics_coupled_orbit *orbit);

/* The distance to which motions on the way to another frequency are found, in static deflections.
 */
extern const double dynamics_coupled_on_the_way;

/* Follows a stable motion to another frequency. FF_NOCONV: it ends or is unstable on the way, and
   `orbit` is the last that was found. */
ff_status dynamics_coupled_follow(dynamics_coupled_run *run, double to, const ff_host *host,
                                  dynamics_coupled_orbit *orbit);

/* The Floquet multipliers of a monodromy as pairs (re, im), and the largest modulus. */
ff_status dynamics_coupled_multipliers(const double *monodromy, double *multipliers,
                                       double *largest);

#endif
