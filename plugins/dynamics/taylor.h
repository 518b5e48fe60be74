/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Taylor series of the motion within one piece of the mesh cycle and one state of contact, where
 *
 *   z'' = load - damper z' - (k + k_rate t) z
 *
 * so that the coefficients follow from a recurrence, and the first exit of the motion through a
 * bound, which no graze escapes.
 */
#ifndef FF_DYNAMICS_TAYLOR_H
#define FF_DYNAMICS_TAYLOR_H

enum { FF_ORDER_MAX = 30 };

/* Columns of a series. */
enum {
    FF_Z,     /* the motion */
    FF_PHI_1, /* response to its start value */
    FF_PHI_2, /* response to its start rate */
    FF_Z_T,   /* derivative after the duration T of the mesh cycle, at a fixed phase */
    FF_COLUMNS
};

typedef struct ff_equation {
    double load, damper, k, k_rate;
} ff_equation;

/* Coefficients of the powers of t/h. */
typedef struct ff_series {
    int order;
    double h;
    double c[FF_ORDER_MAX + 1][FF_COLUMNS];
} ff_series;

/* Steps of this size, in ff_step_size, are expanded to round-off with some 20 terms. */
extern const double ff_longest_step;
double ff_step_size(const ff_equation *q, double h);

/* The motion alone, from (z, rate). */
void ff_expand_motion(const ff_equation *q, double h, const double z[2], ff_series *s);

/* All columns; z_T holds the derivatives of z and of its rate after T. */
void ff_expand(const ff_equation *q, double T, double h, const double z[2], const double z_T[2],
               ff_series *s);

/* Value and rate (per t) of one column, or of all, at t = x h. */
void ff_taylor_at(const ff_series *s, int column, double x, double at[2]);
void ff_series_columns_at(const ff_series *s, double x, double value[FF_COLUMNS],
                          double rate[FF_COLUMNS]);

/* First x in (0, 1] at which the polynomial of that order falls below 0, 0 when it does so at once,
   or -1. A start value within `tiny` of 0 counts as 0. Intervals are halved until the value or the
   slope has a certain sign all over, so that two crossings close to each other are seen. */
double ff_first_exit(const double *p, int order, double tiny);

#endif
