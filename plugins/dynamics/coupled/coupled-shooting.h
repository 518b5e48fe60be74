/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stable periodic motions of a pair on its bearings by Newton's method, and their continuation over
 * the speed. */
#ifndef DYNAMICS_COUPLED_SHOOTING_H
#define DYNAMICS_COUPLED_SHOOTING_H

#include "../oscillator/settle.h"
#include "coupled-run.h"

/* A motion at a mesh frequency (relative to the natural frequency), and the cost of finding it. */
typedef struct dynamics_coupled_orbit {
    double frequency;
    int period;                   /* mesh cycles */
    double state[DYNAMICS_TAKEN]; /* at phase 0 */
    double distance;              /* largest change of a coordinate in the last correction */
    double largest;               /* largest modulus of the multipliers; 0: no motion was found */
    int touches;   /* 1: the driving flanks never part and the back flanks never meet */
    size_t cycles; /* cycles integrated so far; never reset */
} dynamics_coupled_orbit;

/* Looks for the stable motion within the distance `far` of orbit->state, and moves that state to
 * it. FF_NOCONV: there is none, or it is unstable; the largest multiplier is set in the second
 * case. */
ff_status dynamics_coupled_shoot(dynamics_coupled_run *run, double far, double tolerance,
                                 const ff_host *host, dynamics_coupled_orbit *orbit);

/* Distance to which motions on the way to another frequency are solved, in static deflections. */
extern const double dynamics_coupled_on_the_way;

/* Follows a stable motion to another frequency. FF_NOCONV: it ends or becomes unstable on the way,
 * and `orbit` is the last motion found. */
ff_status dynamics_coupled_follow(dynamics_coupled_run *run, double to, const ff_host *host,
                                  dynamics_coupled_orbit *orbit);

/* Computes the Floquet multipliers of a monodromy as pairs (re, im), and the largest modulus. */
ff_status dynamics_coupled_multipliers(const double *monodromy, double *multipliers,
                                       double *largest);

#endif
