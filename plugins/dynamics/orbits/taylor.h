/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Taylor series of the motion within one piece of the mesh cycle and one state of contact, where
 *
 *   z'' = load - drag - e'' - damper z' - k z,    k = k_0 + k_1 t + ..., and drag and e likewise,
 *
 * so that the coefficients follow from a recurrence. And the first exit of the motion through a
 * bound, which finds grazing contacts, too.
 */
#ifndef DYNAMICS_TAYLOR_H
#define DYNAMICS_TAYLOR_H

#include "../excitation/excitation.h"

enum { DYNAMICS_ORDER_MAX = 30 };

/* Columns of a series. */
enum {
    DYNAMICS_Z,     /* the motion */
    DYNAMICS_PHI_1, /* response to its start value */
    DYNAMICS_PHI_2, /* response to its start rate */
    DYNAMICS_Z_T,   /* derivative by the duration T of the mesh cycle, at a fixed phase */
    DYNAMICS_COLUMNS
};

typedef struct dynamics_piece_equation {
    double load, damper;
    int degree; /* of k, e and drag */
    int drags;  /* whether there is a drag */
    double k[DYNAMICS_DEGREE + 1], e[DYNAMICS_DEGREE + 1], drag[DYNAMICS_DEGREE + 1];
} dynamics_piece_equation;

/* The coefficients of the powers of t/h. */
typedef struct dynamics_taylor_series {
    int order;
    int converged; /* whether what is left out is round-off */
    double h;
    double c[DYNAMICS_ORDER_MAX + 1][DYNAMICS_COLUMNS];
} dynamics_taylor_series;

/* A step of this size, as dynamics_taylor_step_size has it, is expanded to round-off with some 24
 * terms, but for a k that bends within it: a series that has not converged wants a shorter one. */
extern const double dynamics_taylor_longest_step;
double dynamics_taylor_step_size(const dynamics_piece_equation *q, double h);

/* Expands the motion alone, from (z, rate). */
void dynamics_taylor_expand_motion(const dynamics_piece_equation *q, double h, const double z[2],
                                   dynamics_taylor_series *s);

/* Expands all columns; z_T holds the derivatives of z and of its rate by T. */
void dynamics_taylor_expand(const dynamics_piece_equation *q, double T, double h, const double z[2],
                            const double z_T[2], dynamics_taylor_series *s);

/* The value and the rate (per t) of one column, or of all, at t = x h. */
void dynamics_taylor_at(const dynamics_taylor_series *s, int column, double x, double at[2]);
void dynamics_taylor_columns_at(const dynamics_taylor_series *s, double x,
                                double value[DYNAMICS_COLUMNS], double rate[DYNAMICS_COLUMNS]);

/* The first x in (0, 1] at which the polynomial of that order falls below 0; 0 when it does so at
   once; -1: it does not. A start value within `tiny` of 0 counts as 0. Intervals are halved until
   the sign of the value or of the slope is certain all over, so that two crossings close to each
   other are seen. */
double dynamics_taylor_first_exit(const double *p, int order, double tiny);

#endif
