/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The history of one contact: the series of a contact stage, linear between their points. */
#ifndef EHL_HISTORY_H
#define EHL_HISTORY_H

#include <flankfilm/plugin.h>

/* Below this share of the largest load the grid is too coarse for the film (time-stepper.h). */
#define EHL_LIGHT_LOAD 0.02

typedef struct ehl_history {
    size_t count;
    const double *time, *radius, *speed_1, *speed_2, *load;
    const double *roll, *gap; /* NULL: not wired */
    const double *engagement; /* the number of each row; NULL: one contact all the time */
    const double *film;       /* ehl_moes_film of each row; NULL: not known */
    double modulus;           /* E', Pa: 2/E' = sum (1 - nu^2)/E */
    double load_floor;        /* N/m; 0: none */
    double load_max;          /* N/m */
    double speed_max;         /* of the entrainment, m/s */
    int mirrored;             /* the entrainment runs towards -x at first */
    int at_rest;              /* it begins without entrainment: EHL_CREEP of speed_max stands in */
    double wakes;             /* for it up to that time, s */
    int turns;                /* it runs the other way later, or a gap is squeezed at rest */
} ehl_history;

/* Share of the largest speed whose film a history begins with that begins at rest. */
#define EHL_CREEP 0.01

/* The contact at one time. `entrainment` is |u1 + u2|/2. */
typedef struct ehl_instant {
    double time, radius, entrainment, sliding, load, gap, roll;
    int mirrored; /* the entrainment runs towards -x */
} ehl_instant;

/* Checks the series and finds the largest load and speed; `h->load_floor` is set before. */
ff_status ehl_history_check(ehl_history *h, const ff_host *host);

/* The engagement that begins at that row, with the largest load of all. Gives the row at which the
   next one begins. */
size_t ehl_history_engagement(const ehl_history *h, size_t row, ehl_history *one);

/* FF_UNSUPPORTED where it begins at rest or turns, for models that carry the film one way. */
ff_status ehl_history_one_way(const ehl_history *h, const ff_host *host, const char *what);

/* Where a time is given twice the contact jumps: ..._at takes the later values, ..._before the
   earlier ones. */
ehl_instant ehl_history_at(const ehl_history *h, double time);
ehl_instant ehl_history_before(const ehl_history *h, double time);
/* Returns 1 when the load counts as none: below a millionth of the largest. */
int ehl_is_lost(const ehl_history *h, double load);

ehl_instant ehl_history_row(const ehl_history *h, size_t row);

/*
 * Returns the latest row's time before `to`, or `to`, up to which a straight line from `from`
 * describes the contact: no row between is off it by more than `within` of the speed and the
 * radius, by twice that of the load, whose root the pressure goes with, or by ten times that of the
 * gap and `film`, m.
 */
double ehl_history_straight(const ehl_history *h, double from, double to, double within,
                            double film);

/* What the instants at which a film is known miss of its history. */
typedef struct ehl_sampling {
    double missed, load;    /* N s/m: what lies off straight lines between them; the whole load */
    double sampled, passed; /* N/m^2: highest load over radius at an instant; at any row */
} ehl_sampling;

/* Adds the time between two neighbouring instants. */
void ehl_history_sample(const ehl_history *h, double from, double to, ehl_sampling *sum);

/* The part of the load that is missed, or of the highest Hertz pressure where that is more. */
double ehl_sampling_missed(const ehl_sampling *s);

/* Number of rows with a time not above `time`. */
size_t ehl_history_rows_before(const ehl_history *h, double time);

/* The lowest films of the engagements of a history, one beside the other. */
typedef struct ehl_lowest {
    double number, count;    /* of the engagement at hand, of all so far */
    double here;             /* lowest film of the one at hand, m */
    double sum, least, most; /* of those before it */
} ehl_lowest;

/* Takes the next film of a history, in its order. */
void ehl_lowest_add(ehl_lowest *l, double engagement, double h_min);

/* Mean of the lowest films, and the highest of them less the lowest. */
double ehl_lowest_mean(const ehl_lowest *l);
double ehl_lowest_spread(const ehl_lowest *l);

#endif
