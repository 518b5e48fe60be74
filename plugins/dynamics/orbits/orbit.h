/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Periodic motions as fixed points of the return map (delta, rate) at phase 0 -> the same after
 * `period` mesh cycles, found by Newton's method. The speed enters as lambda = ln(mesh frequency /
 * natural frequency): T = 2 pi exp(-lambda).
 */
#ifndef DYNAMICS_ORBIT_H
#define DYNAMICS_ORBIT_H

#include "flow.h"

enum { DYNAMICS_PERIOD_MAX = 6 };

/*
 * The films of an orbit at phase 0 belong to its state. The films that fit to (delta, rate, lambda)
 * are eliminated: m, end and slope are those of the map in which the films have followed, and a
 * film that is handed on follows each change of (delta, rate, lambda), so that Newton's method in
 * these is Newton's method in all. The multipliers are those of the whole state.
 */
typedef struct dynamics_films {
    int known;
    double film[2]; /* at phase 0 */
    double miss;    /* the largest difference to the films at the end */
    double step[2]; /* Newton's correction at the same (delta, rate, lambda) */
    double at[3];   /* (delta, rate, lambda) of the last map, and the change of the films by them */
    double by[2][3];
    double m[4][4]; /* monodromy in (delta, rate, films) */
} dynamics_films;

typedef struct dynamics_orbit {
    int period;
    double lambda;
    double x[2];     /* (delta, rate) at phase 0, before the node */
    double end[2];   /* where it gets, after `period` cycles */
    double half[2];  /* where it is after half of them, when `period` is even */
    double m[4];     /* monodromy: derivative of `end` by x */
    double slope[2]; /* derivative of `end` by lambda */
    double det;      /* of m, as the product over all steps, free of cancellation */
    int moments;     /* whether the map finds the rms, too */
    double rms;      /* as dynamics_orbit_rms has it */
    dynamics_films films;
} dynamics_orbit;

/* T = 2 pi exp(-lambda), rad of the natural frequency. */
double dynamics_cycle_duration(double lambda);

/* The unit in which states near x are compared: the static deflection and the size of the motion
   about the edge of the driving flank. */
double dynamics_state_unit(const dynamics_excitation *excitation, const double x[2]);

/* Fills in all but period, lambda and x; 0: the motion is unbounded or takes too many steps. */
int dynamics_orbit_map(const dynamics_flow *flow, dynamics_orbit *orbit);

/* The tolerance of an orbit that is shown or followed: a few roundings above the least. */
extern const double dynamics_orbit_accuracy;

/* The state at phase 0. */
dynamics_state dynamics_orbit_start(const dynamics_orbit *orbit);

/* Newton's method with step halving, from orbit->x, until the motion meets its start to `tolerance`
   times the state's unit. 1: found. */
int dynamics_orbit_solve(const dynamics_flow *flow, double tolerance, dynamics_orbit *orbit);

/* The distance by which the motion misses its start, in the state's unit. */
double dynamics_orbit_residual(const dynamics_excitation *excitation, const dynamics_orbit *orbit);

/* 1 - tr M + det M = (1 - mu1)(1 - mu2) vanishes where a multiplier passes 1, at a fold, and
   1 + tr M + det M where one passes -1, at a period doubling. */
double dynamics_fold_test(const dynamics_orbit *orbit);
double dynamics_doubling_test(const dynamics_orbit *orbit);
double dynamics_largest_multiplier(const dynamics_orbit *orbit);

/* Whether no disturbance grows: whether no multiplier reaches dynamics_stable_multiplier, which
   leaves room for round-off above 1, since without damping no disturbance decays either. */
extern const double dynamics_stable_multiplier;
int dynamics_orbit_is_stable(const dynamics_orbit *orbit);

/* Reduces the period to a divisor of it after which the motion already repeats itself. */
void dynamics_orbit_reduce(const dynamics_flow *flow, dynamics_orbit *orbit);

/* The distance to the nearest of the states that `other` passes at phase 0, in the state's unit; 0:
   too many steps. */
int dynamics_orbit_distance(const dynamics_flow *flow, const dynamics_orbit *orbit,
                            const double other[2], double *distance);

/* rms of the alternating part of s over the period, in units of excitation->length; 0: too many
   steps. */
int dynamics_orbit_rms(const dynamics_flow *flow, const dynamics_orbit *orbit, double *rms);

#endif
