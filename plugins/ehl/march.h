/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film through time: a steady start, then implicit steps that are cut where they fail. */
#ifndef EHL_MARCH_H
#define EHL_MARCH_H

#include "history.h"
#include "roughness.h"
#include "solver.h"

enum { EHL_EULER = 0, EHL_BDF2 = 1, EHL_STATES = 3 };

typedef struct ehl_state {
    ehl_film film;
    double *mass; /* rho h */
    double *gap;  /* h */
    double time;
    double moved;    /* whole cells that the nodes had moved on by with the oil; rough flanks */
    double thinnest; /* least h of all nodes, m */
    int loaded;
} ehl_state;

typedef struct ehl_march {
    const ehl_history *history;
    ehl_roughness *rough; /* NULL: smooth flanks */
    ehl_solver *solver;
    int scheme;                  /* EHL_EULER or EHL_BDF2 */
    ehl_state state[EHL_STATES]; /* newest first */
    size_t known;                /* states that hold a film */
    size_t smooth;               /* newest states with no kink of the history between them */
    ehl_state trial, spare;
    ehl_step trial_step;
    ehl_instant trial_at;
    double *memory, *past, *change, *deflection, *heights;
    double *local;             /* truncation of the last step over rho h, 0 outside the contact */
    double *accumulated_error; /* the sum of it, carried along with the film */
    double distance_of_jump; /* m that the film still has to go from the last leap of the load on */
    unsigned char *flags_memory;
    ehl_step step;                   /* the last one accepted */
    ehl_instant at;                  /* its instant */
    int mirrored;                    /* the nodes run against x: the oil always runs along them */
    int contact_lost;                /* the contact was lost then */
    double moved;                    /* of the instant that is placed */
    double last_good_step;           /* s; the step that rough flanks allowed lately */
    int good_steps;                  /* of such steps */
    double steps_cut, steps_refused; /* refused for their truncation */
    double pressureless_steps;       /* bare: carried on without pressure */
    double worst_truncation, worst_truncation_at; /* largest `local`, and its time */
    double distance, renewed;                     /* m that the film came; s when 2 a were passed */
    int start_unloaded;                           /* the history begins without load */
    char why[256];                                /* what failed */
} ehl_march;

ff_status ehl_march_create(ehl_march *m, const ehl_history *h, ehl_solver *s, int scheme);
void ehl_march_destroy(ehl_march *m);

/* The steady film of the first instant; without load there, that of a light one, and at rest that
   of a creep, or the gap full of oil. */
ff_status ehl_march_start(ehl_march *m);

/* Forgets the film, before the start of another engagement; the counts go on. */
void ehl_march_restart(ehl_march *m);

/* On to `time`, in one step unless it fails. FF_OK, or FF_NOCONV with `why`. */
ff_status ehl_march_to(ehl_march *m, double time);

/* One implicit step to that instant: leaves it in `trial` with its truncation in `local`. */
ff_status ehl_march_try(ehl_march *m, const ehl_instant *at);

/* The trial, weighed, becomes the newest state. */
void ehl_march_accept(ehl_march *m);

/* Where not even the shortest step to `at` converges: without load the flanks part as prescribed,
   without pressure. FF_OK, or FF_NOCONV with `why`. */
ff_status ehl_march_without_load(ehl_march *m, const ehl_instant *at);

/* The next steps start anew: the history has a kink at the newest state. */
void ehl_march_breakpoint(ehl_march *m);

/* Largest `local` over the nodes. */
double ehl_march_truncation(const ehl_march *m);

/* The film thins so fast in the trial, or moves so far as it takes over with the contact lost, that
   the step should be cut. */
int ehl_march_step_too_large(const ehl_march *m);

/* Time in which the film passes the widest contact of the history at that speed; all of the history
   where it is shorter. */
double ehl_march_passage(const ehl_march *m, double speed);

/* 1: the newest film bears 2 % of the largest load or more. Under less the grid is not made for it,
   and its errors count for nothing. */
int ehl_march_is_loaded(const ehl_march *m);

/* No load, or not yet enough to land: the dynamics prescribes the gap (contact-loss.c). */
int ehl_contact_is_lost(const ehl_march *m, const ehl_instant *at);

/* Fills film with a first guess for a steady film under `at` that is `thinnest` at its thinnest. */
void ehl_first_guess(ehl_solver *s, const ehl_instant *at, double modulus, double thinnest,
                     ehl_film *film);

#endif
