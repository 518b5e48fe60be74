/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film through time: a steady start, then implicit steps that are cut where they fail. */
#ifndef FF_EHL_MARCH_H
#define FF_EHL_MARCH_H

#include "history.h"
#include "solver.h"

enum { FF_EULER = 0, FF_BDF2 = 1, FF_STATES = 4 };

typedef struct ff_state {
    ff_film film;
    double *mass; /* rho h */
    double time, gap;
    int loaded;
} ff_state;

typedef struct ff_march {
    const ff_history *history;
    ff_solver *solver;
    int scheme;                /* FF_EULER or FF_BDF2 */
    ff_state state[FF_STATES]; /* newest first */
    size_t known;              /* states that hold a film */
    ff_state trial;
    double *memory, *past, *change, *deflection;
    unsigned char *wet_memory;
    ff_step step;  /* the last one solved */
    ff_instant at; /* its instant */
    size_t accepted;
    double steps_cut, bare_steps; /* bare: carried on without pressure */
    int start_unloaded;           /* the history begins without load */
    int start_cut;                /* the steady start needed a march of its own */
    char why[256];                /* what failed */
} ff_march;

ff_status ff_march_create(ff_march *m, const ff_history *h, ff_solver *s, int scheme);
void ff_march_destroy(ff_march *m);

/* The steady film of the first instant; without load there, that of 1 % of the largest load. */
ff_status ff_march_start(ff_march *m);

/* On to `time`, in one step unless it fails. FF_OK, or FF_NOCONV with `why`. */
ff_status ff_march_to(ff_march *m, double time);

/* Fills film with a first guess for a steady film under `at` that is `thinnest` at its thinnest. */
void ff_first_guess(ff_solver *s, const ff_instant *at, double modulus, double thinnest,
                    ff_film *film);

#endif
