/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stable periodic motions of a pair on elastic bearings by Newton's method, and their continuation
   over the speed. */
#ifndef DYNAMICS_COUPLED_SHOOTING_H
#define DYNAMICS_COUPLED_SHOOTING_H

#include "../oscillator/settle.h"
#include "coupled-run.h"

/* A motion at a mesh frequency (relative to the natural frequency), and the number of cycles
   integrated to find it. */
typedef struct dynamics_coupled_orbit {
    double frequency;
    int period;                   /* mesh cycles */
    double state[DYNAMICS_TAKEN]; /* state at phase 0 */
    double distance;              /* largest change of a coordinate in the last correction */
    double largest;               /* largest modulus of the multipliers; 0: no motion was found */
    int touches;   /* 1: the driving flanks never separate and the back flanks never touch */
    size_t cycles; /* number of integrated cycles so far; never reset */
} dynamics_coupled_orbit;

/* Looks for the stable motion within the distance `far` of orbit->state, and replaces this state by
   that of the motion. Returns FF_NOCONV if there is no motion, or if it is unstable; if it is
   unstable, `largest` is set. */
ff_status dynamics_coupled_shoot(dynamics_coupled_run *run, double far, double tolerance,
                                 const ff_host *host, dynamics_coupled_orbit *orbit);

/* Accuracy of intermediate motions during continuation to another frequency, in static
   deflections. */
extern const double dynamics_coupled_on_the_way;

/* Follows a stable motion to another frequency. Returns FF_NOCONV if it ends or becomes unstable on
   the way; `orbit` is then the last motion found. */
ff_status dynamics_coupled_follow(dynamics_coupled_run *run, double to, const ff_host *host,
                                  dynamics_coupled_orbit *orbit);

/* Computes the Floquet multipliers of a monodromy as pairs (re, im), and the largest modulus. */
ff_status dynamics_coupled_multipliers(const double *monodromy, double *multipliers,
                                       double *largest);

#endif
