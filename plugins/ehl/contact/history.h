/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The history of one contact: the time series of a contact stage, linear between their points. */
#ifndef EHL_HISTORY_H
#define EHL_HISTORY_H

#include <flankfilm/plugin.h>

/* Share of the largest load below which the grid is too coarse for the film (time-stepper.h). */
#define EHL_LIGHT_LOAD 0.02

typedef struct ehl_history {
    size_t count;
    const double *time, *radius, *speed_1, *speed_2, *load;
    const double *roll, *gap; /* NULL: not wired */
    const double *engagement; /* number of the engagement of each row; NULL: a single contact */
    const double *film;       /* ehl_moes_film of each row; NULL: not stored */
    double modulus;           /* E', Pa: 2/E' = sum (1 - nu^2)/E */
    double load_floor;        /* smallest load that is used, N/m; 0: no lower bound */
    double load_max;          /* N/m */
    double speed_max;         /* largest entrainment speed, m/s */
    int mirrored;             /* whether the entrainment is towards -x at the start */
    int at_rest;  /* 1: the history begins without entrainment; until `wakes`, the entrainment is at
                     least EHL_CREEP times speed_max */
    double wakes; /* time at which that lower bound ends, s */
    int turns;    /* 1: the entrainment reverses later, or a gap is squeezed at rest */
} ehl_history;

/* Entrainment speed at the start of a history that begins at rest, as a share of the largest
   entrainment speed. */
#define EHL_CREEP 0.01

/* The contact at one time. `entrainment` is |u1 + u2|/2. */
typedef struct ehl_instant {
    double time, radius, entrainment, sliding, load, gap, roll;
    int mirrored; /* whether the entrainment is towards -x */
} ehl_instant;

/* Checks the series and finds the largest load and speed. `h->load_floor` is already set. */
ff_status ehl_history_check(ehl_history *h, const ff_host *host);

/* Sets *one to the engagement that begins at the row; its load_max is that of the whole history.
   Returns the row at which the next engagement begins. */
size_t ehl_history_engagement(const ehl_history *h, size_t row, ehl_history *one);

/* Returns FF_UNSUPPORTED if the history begins at rest or the entrainment reverses, for models that
   support one direction only. */
ff_status ehl_history_one_way(const ehl_history *h, const ff_host *host, const char *what);

/* Return the contact at a time. If a time is given twice the contact jumps there: ..._at returns
   the later values, ..._before the earlier ones. */
ehl_instant ehl_history_at(const ehl_history *h, double time);
ehl_instant ehl_history_before(const ehl_history *h, double time);
/* Returns 1 if the load counts as zero: below a millionth of the largest. */
int ehl_is_lost(const ehl_history *h, double load);

ehl_instant ehl_history_row(const ehl_history *h, size_t row);

/* Returns the largest time of a row before `to`, or `to` itself, up to which a straight line from
   `from` describes the contact. Rows in between may deviate from the line by these shares of their
   values: `within` for speed and radius, twice `within` for the load (pressure is proportional to
   its square root), and ten times `within` for the gap plus `film` (m). */
double ehl_history_straight(const ehl_history *h, double from, double to, double within,
                            double film);

/* The part of a history that is missed between the instants of a film. */
typedef struct ehl_sampling {
    double missed, load;    /* missed: integral over time of the load's deviation from straight
                               lines between instants; load: integral of the load, N s/m */
    double sampled, passed; /* largest load over radius at any instant of the film, and at any
                               row of the history, N/m^2 */
} ehl_sampling;

/* Adds the time between two neighbouring instants. */
void ehl_history_sample(const ehl_history *h, double from, double to, ehl_sampling *sum);

/* Returns the missed share of the load, or the missed share of the largest Hertz pressure if this
   share is larger. */
double ehl_sampling_missed(const ehl_sampling *s);

/* Returns the number of rows with a time not above `time`. */
size_t ehl_history_rows_before(const ehl_history *h, double time);

/* Statistics of the lowest film of each engagement. */
typedef struct ehl_lowest {
    double number, count;    /* number of the current engagement, and number of engagements so
                                far */
    double here;             /* lowest film of the current engagement, m */
    double sum, least, most; /* statistics of the engagements before it */
} ehl_lowest;

/* Adds the next film of a history, in order of time. */
void ehl_lowest_add(ehl_lowest *l, double engagement, double h_min);

/* Return the mean of the lowest films, and the largest minus the smallest of these lowest films. */
double ehl_lowest_mean(const ehl_lowest *l);
double ehl_lowest_spread(const ehl_lowest *l);

#endif
