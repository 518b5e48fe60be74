/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film through time: a steady start, then implicit steps that are cut where they fail. */
#ifndef FF_EHL_MARCH_H
#define FF_EHL_MARCH_H

#include "history.h"
#include "rough.h"
#include "solver.h"

enum { FF_EULER = 0, FF_BDF2 = 1, FF_STATES = 3 };

typedef struct ff_state {
    ff_film film;
    double *mass; /* rho h */
    double *gap;  /* h */
    double time;
    double moved;    /* whole cells that the nodes had moved on by with the oil; rough flanks */
    double thinnest; /* least h of all nodes, m */
    int loaded;
} ff_state;

typedef struct ff_march {
    const ff_history *history;
    ff_rough *rough; /* NULL: smooth flanks */
    ff_solver *solver;
    int scheme;                /* FF_EULER or FF_BDF2 */
    ff_state state[FF_STATES]; /* newest first */
    size_t known;              /* states that hold a film */
    size_t smooth;             /* newest states with no kink of the history between them */
    ff_state trial, spare;
    ff_step trial_step;
    ff_instant trial_at;
    double *memory, *past, *change, *deflection, *heights;
    double *local; /* truncation of the last step over rho h, 0 outside the contact */
    double *drift; /* the sum of it, carried along with the film */
    double leapt;  /* m that the film still has to go from the last leap of the load on */
    unsigned char *wet_memory;
    ff_step step;                    /* the last one accepted */
    ff_instant at;                   /* its instant */
    int mirrored;                    /* the nodes run against x: the oil always runs along them */
    int flying;                      /* the contact was lost then */
    double moved;                    /* of the instant that is placed */
    double bold;                     /* s; the step that rough flanks allowed lately */
    int streak;                      /* of such steps */
    double steps_cut, steps_refused; /* refused for their truncation */
    double bare_steps;               /* bare: carried on without pressure */
    double worst_truncation, worst_truncation_at; /* largest `local`, and its time */
    double way, renewed;                          /* m that the film came; s when 2 a were passed */
    int start_unloaded;                           /* the history begins without load */
    char why[256];                                /* what failed */
} ff_march;

ff_status ff_march_create(ff_march *m, const ff_history *h, ff_solver *s, int scheme);
void ff_march_destroy(ff_march *m);

/* The steady film of the first instant; without load there, that of a light one, and at rest that
   of a creep, or the gap full of oil. */
ff_status ff_march_start(ff_march *m);

/* Forgets the film, before the start of another engagement; the counts go on. */
void ff_march_renew(ff_march *m);

/* On to `time`, in one step unless it fails. FF_OK, or FF_NOCONV with `why`. */
ff_status ff_march_to(ff_march *m, double time);

/* One implicit step to that instant: leaves it in `trial` with its truncation in `local`. */
ff_status ff_march_try(ff_march *m, const ff_instant *at);

/* The trial, weighed, becomes the newest state. */
void ff_march_accept(ff_march *m);

/* Where not even the shortest step to `at` converges: without load the flanks part as prescribed,
   without pressure. FF_OK, or FF_NOCONV with `why`. */
ff_status ff_march_rescue(ff_march *m, const ff_instant *at);

/* The next steps start anew: the history has a kink at the newest state. */
void ff_march_kink(ff_march *m);

/* Largest `local` over the nodes. */
double ff_march_truncation(const ff_march *m);

/* The film thins so fast in the trial, or moves so far as it takes over in flight, that the step
   should be cut. */
int ff_march_hasty(const ff_march *m);

/* Time in which the film passes the widest contact of the history at that speed; all of the history
   where it is shorter. */
double ff_march_passage(const ff_march *m, double speed);

/* 1: the newest film bears 2 % of the largest load or more. Under less the grid is not made for it,
   and its errors count for nothing. */
int ff_march_bears(const ff_march *m);

/* No load, or not yet enough to land: the dynamics prescribes the gap (flight.c). */
int ff_in_flight(const ff_march *m, const ff_instant *at);

/* Fills film with a first guess for a steady film under `at` that is `thinnest` at its thinnest. */
void ff_first_guess(ff_solver *s, const ff_instant *at, double modulus, double thinnest,
                    ff_film *film);

#endif
