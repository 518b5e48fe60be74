/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The films of a march through time: its states, and the difference formula between them. */
#ifndef EHL_MARCH_H
#define EHL_MARCH_H

#include "../contact/history.h"
#include "../contact/surface.h"
#include "solver.h"

enum { EHL_EULER = 0, EHL_BDF2 = 1, EHL_STATES = 3 };
/* Multiple of the contact film below which asperities nearly touch, and hold the film. */
enum { EHL_NEAR_CONTACT = 2 };
/* Force of the film, as a share of the largest load, that the dynamics may neglect while the
   contact is lost. */
#define EHL_LOST_FORCE 0.01

typedef struct ehl_state {
    ehl_film film;
    double *mass; /* rho h */
    double *gap;  /* h */
    double *heat; /* temperatures, thermal.h; NULL: that of the oil */
    double time;
    double moved;    /* whole cells by which the nodes had moved with the oil; rough flanks */
    double thinnest; /* least h of all nodes, m */
    double highest;  /* greatest p of all nodes, Pa */
    int loaded;
    int recursion; /* steps since the deflection that it stems from was computed anew */
} ehl_state;

typedef struct ehl_march {
    const ehl_history *history;
    ehl_roughness *rough;        /* NULL: smooth flanks */
    struct ehl_heat *heat;       /* heat.h; NULL: the film has the temperature of the oil */
    struct ehl_thermal *thermal; /* thermal.h; NULL: no temperatures across the film */
    ehl_solver *solver;
    int scheme;                  /* EHL_EULER or EHL_BDF2 */
    ehl_state state[EHL_STATES]; /* newest first */
    size_t known;                /* states that hold a film */
    size_t smooth;               /* newest states with no breakpoint of the history between them */
    ehl_state trial, spare;
    ehl_step trial_step;
    ehl_instant trial_at;
    double *memory, *past, *change, *deflection, *heights;
    double *local;             /* truncation of the last step over rho h; 0 outside the contact */
    double *accumulated_error; /* sum of `local`, carried along with the film */
    double distance_of_jump;   /* m, how far the film must still move until a jump of the load has
                                  left it */
    unsigned char *flags_memory;
    ehl_step step;         /* the last one accepted */
    ehl_instant at;        /* its instant */
    int mirrored;          /* the nodes run against x, since the oil always runs along the nodes */
    int contact_lost;      /* the contact was lost at that instant */
    double moved;          /* `moved` of the instant that is placed */
    double last_good_step; /* s, the step that rough flanks allowed lately */
    int good_steps;        /* how many of such steps have passed */
    double steps_cut, steps_refused; /* steps_refused: taken again for their truncation */
    double pressureless_steps;       /* steps in which the film was carried on without pressure */
    double worst_truncation, worst_truncation_at; /* largest `local`, and its time */
    double distance, renewed; /* m that the film has moved; s when that was 2 a */
    int start_unloaded;       /* the history begins without load */
    char why[256];            /* what failed */
} ehl_march;

ff_status ehl_march_create(ehl_march *m, const ehl_history *h, ehl_solver *s, int scheme);
void ehl_march_destroy(ehl_march *m);

ehl_step ehl_instant_step(const ehl_march *m, const ehl_instant *at);
/* Adds what the oil in front of the domain does at that instant. */
void ehl_feed_step(const ehl_solver *s, const ehl_instant *at, ehl_step *step);
void ehl_copy_film(ehl_film *to, const ehl_film *from, size_t nodes);
double ehl_thinnest(ehl_march *m, double radius, const ehl_film *film);

/* Returns 1 without load, or when the load is still too small to end a contact loss: the dynamics
   prescribes the gap then (contact-loss.c). */
int ehl_contact_is_lost(const ehl_march *m, const ehl_instant *at);

/* Returns the time in which the film passes the widest contact of the history at that speed, s; no
   more than the whole history. */
double ehl_march_passage(const ehl_march *m, double speed);

/* Returns 1 when the newest film carries 2 % of the largest load or more. Below that the grid is
   too coarse for the film, and its errors do not count. */
int ehl_march_is_loaded(const ehl_march *m);

/* Starts the difference formula anew: the history has a breakpoint at the newest state. */
void ehl_march_breakpoint(ehl_march *m);

/* The change in time at `time` is c[0] y + c[1] y(state 0) + c[2] y(state 1). */
void ehl_march_factors(const ehl_march *m, double time, double c[3]);

/* Lagrange's factors that extrapolate the `count` newest states to `time`; 0 for older states. */
void ehl_lagrange_factors(const ehl_march *m, double time, size_t count, double *c);

/* Counts the newest states, loaded or all unloaded, that a polynomial in time may go through. */
size_t ehl_run_of_states(const ehl_march *m, int loaded, size_t most);

/* Removes the pressure and leaves the oil where it is. */
void ehl_remove_pressure(ehl_film *film, const double *mass, size_t nodes);

#endif
