/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Taylor series of the motion within one piece of the mesh cycle and one state of contact. The
   equation is z'' = load - drag - e'' - damper z' - k z, with k = k_0 + k_1 t + ..., and drag and e
   polynomials in t, too. The coefficients follow from a recurrence. A root finder locates the first
   time at which the motion crosses a bound, including grazing contacts. */
#ifndef DYNAMICS_TAYLOR_H
#define DYNAMICS_TAYLOR_H

#include "../excitation/excitation.h"

enum { DYNAMICS_ORDER_MAX = 30 };

/* Columns of a series, one for the motion and one for each derivative. */
enum {
    DYNAMICS_Z,     /* the motion */
    DYNAMICS_PHI_1, /* response to its start value */
    DYNAMICS_PHI_2, /* response to its start rate */
    DYNAMICS_Z_T,   /* derivative with respect to the duration T of the mesh cycle, at fixed
                       phase */
    DYNAMICS_COLUMNS
};

typedef struct dynamics_piece_equation {
    double load, damper;
    int degree; /* degree of k, e and drag */
    int drags;  /* 1: there is a drag */
    double k[DYNAMICS_DEGREE + 1], e[DYNAMICS_DEGREE + 1], drag[DYNAMICS_DEGREE + 1];
} dynamics_piece_equation;

/* Coefficients of the powers of t/h. */
typedef struct dynamics_taylor_series {
    int order;
    int converged; /* 1: the remainder is below round-off */
    double h;
    double c[DYNAMICS_ORDER_MAX + 1][DYNAMICS_COLUMNS];
} dynamics_taylor_series;

/* A step of this size (by dynamics_taylor_step_size) needs about 24 terms to reach round-off. If k
   is not linear within the step, the series may not converge; a shorter step is then needed. */
extern const double dynamics_taylor_longest_step;
double dynamics_taylor_step_size(const dynamics_piece_equation *q, double h);

/* Expands the motion alone from (z, rate). */
void dynamics_taylor_expand_motion(const dynamics_piece_equation *q, double h, const double z[2],
                                   dynamics_taylor_series *s);

/* Expands all columns. z_T contains the derivatives of z and of its rate with respect to T. */
void dynamics_taylor_expand(const dynamics_piece_equation *q, double T, double h, const double z[2],
                            const double z_T[2], dynamics_taylor_series *s);

/* Evaluates the value and the rate (per t) of one column, or of all columns, at t = x h. */
void dynamics_taylor_at(const dynamics_taylor_series *s, int column, double x, double at[2]);
void dynamics_taylor_columns_at(const dynamics_taylor_series *s, double x,
                                double value[DYNAMICS_COLUMNS], double rate[DYNAMICS_COLUMNS]);

/* Finds the first x in (0, 1] at which the polynomial becomes negative. Returns 0 if it is negative
   from the start, -1 if it is never negative. A start value within `tiny` of 0 counts as 0.
   Intervals are halved until the sign of the value or of the slope is certain throughout, so that
   two crossings close to each other are found. */
double dynamics_taylor_first_exit(const double *p, int order, double tiny);

#endif
