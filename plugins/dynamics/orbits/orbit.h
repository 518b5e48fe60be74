/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Periodic motions as fixed points of the return map, found by Newton's method. The map takes
 * (delta, rate) at phase 0 to the same quantities after `period` mesh cycles. The speed enters as
 * lambda = ln(mesh frequency / natural frequency): T = 2 pi exp(-lambda).
 */
#ifndef DYNAMICS_ORBIT_H
#define DYNAMICS_ORBIT_H

#include "flow.h"

enum { DYNAMICS_PERIOD_MAX = 6 };

/* The films at phase 0 are part of the state of an orbit. Newton's method solves for (delta, rate,
   lambda) alone: the films are eliminated from m, end and slope, and the stored films are updated
   to first order with each change of (delta, rate, lambda). This is equivalent to Newton's method
   in the whole state. The multipliers are computed for the whole state. */
typedef struct dynamics_films {
    int known;
    double film[2]; /* films at phase 0 */
    double miss;    /* largest difference between the films at the start and at the end */
    double step[2]; /* Newton's correction at fixed (delta, rate, lambda) */
    double at[3];   /* at: (delta, rate, lambda) of the last map; by[][]: derivatives of the films
                       with respect to these three */
    double by[2][3];
    double m[4][4]; /* monodromy in (delta, rate, films) */
} dynamics_films;

typedef struct dynamics_orbit {
    int period;
    double lambda;
    double x[2];     /* (delta, rate) at phase 0, before the node */
    double end[2];   /* (delta, rate) after `period` cycles */
    double half[2];  /* (delta, rate) after half of the cycles, if `period` is even */
    double m[4];     /* monodromy: derivative of `end` with respect to x */
    double slope[2]; /* derivative of `end` with respect to lambda */
    double det;      /* determinant of m, computed as a product over all steps, free of
                        cancellation */
    int moments;     /* 1: the map also computes the rms */
    double rms;      /* rms as dynamics_orbit_rms computes it */
    dynamics_films films;
} dynamics_orbit;

/* Returns T = 2 pi exp(-lambda), in radians of the natural frequency. */
double dynamics_cycle_duration(double lambda);

/* Returns the unit in which states near x are compared: static deflection plus the distance of x
   from contact of the driving flanks. */
double dynamics_state_unit(const dynamics_excitation *excitation, const double x[2]);

/* Computes the map and its derivatives. period, lambda and x are given. Returns 0 if the motion is
   unbounded or takes too many steps. */
int dynamics_orbit_map(const dynamics_flow *flow, dynamics_orbit *orbit);

/* Tolerance for an orbit that is shown or continued: a few round-off errors above the smallest
   possible residual. */
extern const double dynamics_orbit_accuracy;

/* Returns the state at phase 0. */
dynamics_state dynamics_orbit_start(const dynamics_orbit *orbit);

/* Solves for the orbit from orbit->x by Newton's method with step halving, until the residual is
   below `tolerance`. Returns 1 if it was found. */
int dynamics_orbit_solve(const dynamics_flow *flow, double tolerance, dynamics_orbit *orbit);

/* Returns the residual: the distance between start and end, in the state's unit. */
double dynamics_orbit_residual(const dynamics_excitation *excitation, const dynamics_orbit *orbit);

/* Test functions. Fold: 1 - tr M + det M = (1 - mu1)(1 - mu2), which is 0 if a multiplier is 1.
   Period doubling: 1 + tr M + det M, which is 0 if a multiplier is -1. */
double dynamics_fold_test(const dynamics_orbit *orbit);
double dynamics_doubling_test(const dynamics_orbit *orbit);
double dynamics_largest_multiplier(const dynamics_orbit *orbit);

/* Returns whether every multiplier is below dynamics_stable_multiplier. This bound is slightly
   above 1 to allow for round-off: without damping the multipliers are 1. */
extern const double dynamics_stable_multiplier;
int dynamics_orbit_is_stable(const dynamics_orbit *orbit);

/* Reduces the period to its smallest divisor after which the motion repeats. */
void dynamics_orbit_reduce(const dynamics_flow *flow, dynamics_orbit *orbit);

/* Moves the start of an orbit by mesh cycles to the state of phase 0 with the largest delta. Cycles
   of a motion that repeats after several of them then have an order that does not depend on how the
   motion was found. */
void dynamics_orbit_order(const dynamics_flow *flow, dynamics_orbit *orbit);

/* Computes the distance of `other` from the nearest of the orbit's states at phase 0, in state
   units. Returns 0 if there are too many steps. */
int dynamics_orbit_distance(const dynamics_flow *flow, const dynamics_orbit *orbit,
                            const double other[2], double *distance);

/* Computes the rms of the alternating part of s over the period, in units of excitation->length.
   Returns 0 if there are too many steps. */
int dynamics_orbit_rms(const dynamics_flow *flow, const dynamics_orbit *orbit, double *rms);

#endif
