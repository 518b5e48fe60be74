/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What one contact goes through: the series of a contact stage, linear between their points. */
#ifndef FF_EHL_HISTORY_H
#define FF_EHL_HISTORY_H

#include <flankfilm/plugin.h>

typedef struct ff_history {
    size_t count;
    const double *time, *radius, *speed_1, *speed_2, *load;
    const double *roll, *gap; /* NULL: not wired */
    const double *engagement; /* the number of each row; NULL: one contact all the time */
    double modulus;           /* E', Pa: 2/E' = sum (1 - nu^2)/E */
    double load_floor;        /* N/m; 0: none */
    double load_max;          /* N/m */
    double speed_max;         /* of the entrainment, m/s */
    int mirrored;             /* the entrainment runs towards -x at first */
    int at_rest;              /* it begins without entrainment: FF_CREEP of speed_max stands in */
    double wakes;             /* for it up to that time, s */
    int turns;                /* it runs the other way later, or a gap is squeezed at rest */
} ff_history;

/* Share of the largest speed whose film a history begins with that begins at rest. */
#define FF_CREEP 0.01

/* The contact at one time. `entrainment` is |u1 + u2|/2. */
typedef struct ff_instant {
    double time, radius, entrainment, sliding, load, gap, roll;
    int mirrored; /* the entrainment runs towards -x */
} ff_instant;

/* Checks the series and finds the largest load and speed; `h->load_floor` is set before. */
ff_status ff_history_check(ff_history *h, const ff_host *host);

/* The engagement that begins at that row, with the largest load of all. Gives the row at which the
   next one begins. */
size_t ff_history_engagement(const ff_history *h, size_t row, ff_history *one);

/* FF_UNSUPPORTED where it begins at rest or turns, for models that carry the film one way. */
ff_status ff_history_one_way(const ff_history *h, const ff_host *host, const char *what);

/* Where a time is given twice the contact jumps: ..._at takes the later values, ..._before the
   earlier ones. */
ff_instant ff_history_at(const ff_history *h, double time);
ff_instant ff_history_before(const ff_history *h, double time);
/* The load counts as none: below a millionth of the largest. */
int ff_is_lost(const ff_history *h, double load);

ff_instant ff_history_row(const ff_history *h, size_t row);

/*
 * The latest row's time before `to`, or `to`, up to which a straight line from `from` tells what
 * the contact goes through: no row between is off it by more than `within` of the speed and the
 * radius, by twice that of the load, whose root the pressure goes with, or by ten times that of the
 * gap and `film`, m.
 */
double ff_history_straight(const ff_history *h, double from, double to, double within, double film);

/* Number of rows with a time not above `time`. */
size_t ff_history_rows_before(const ff_history *h, double time);

#endif
