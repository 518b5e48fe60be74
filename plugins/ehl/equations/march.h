/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A march of films through time: its states, and the finite-difference formula in time. */
#ifndef EHL_MARCH_H
#define EHL_MARCH_H

#include "../contact/history.h"
#include "../contact/surface.h"
#include "solver.h"

enum { EHL_EULER = 0, EHL_BDF2 = 1, EHL_STATES = 3 };
/* If the film is thinner than this multiple of the contact film, asperities are nearly in contact
   and slow the thinning of the film. */
enum { EHL_NEAR_CONTACT = 2 };
/* Force of the film during contact loss, over the largest load, that the dynamics may neglect. */
#define EHL_LOST_FORCE 0.01

typedef struct ehl_state {
    ehl_film film;
    double *mass; /* rho h */
    double *gap;  /* h */
    double *heat; /* temperatures (thermal.h); NULL: the oil's temperature everywhere */
    double time;
    double moved;    /* rough flanks: whole number of cells by which the nodes had moved with the
                        oil */
    double thinnest; /* smallest h of all nodes, m */
    double highest;  /* largest p of all nodes, Pa */
    int loaded;
    int recursion; /* number of steps since the deflection was last computed from scratch */
} ehl_state;

typedef struct ehl_march {
    const ehl_history *history;
    ehl_roughness *rough;            /* NULL: smooth flanks */
    struct ehl_heat *heat;           /* NULL: the film has the temperature of the oil */
    struct ehl_transport *transport; /* NULL: errors are not requested */
    struct ehl_thermal *thermal;     /* NULL: no temperature across the film */
    ehl_solver *solver;
    int scheme;                  /* EHL_EULER or EHL_BDF2 */
    ehl_state state[EHL_STATES]; /* newest first */
    size_t known;                /* number of states that contain a film */
    size_t smooth; /* number of newest states without a breakpoint of the history between them */
    ehl_state trial, spare;
    ehl_step trial_step;
    ehl_instant trial_at;
    int evaluated; /* 1: the equations have the values and slopes of the trial's last Newton step */
    double *memory, *past, *change, *deflection, *heights;
    double *local; /* truncation error of the last step over rho h; 0 outside the contact */
    double *accumulated_error; /* sum of `local`, transported with the film */
    double distance_of_jump;   /* distance that the film must still move until oil that was in the
                                  contact at a jump of the load has left, m */
    unsigned char *flags_memory;
    ehl_step step;         /* the last accepted step */
    ehl_instant at;        /* instant of that step */
    int mirrored;          /* 1: the nodes are numbered against x, so that the oil moves towards
                              increasing node numbers */
    int contact_lost;      /* 1: contact was lost at that instant */
    double moved;          /* number of cells by which the nodes have moved with the oil at the
                              current instant */
    double last_good_step; /* last step length that succeeded with rough flanks, s */
    int good_steps;        /* number of steps of this length since then */
    double exactness;      /* factor on the default tolerances of the solver and of the iteration
                              between film and temperature */
    double steps_cut, steps_refused; /* steps_refused: steps that were repeated because of
                                      * their truncation error */
    double pressureless_steps;       /* number of steps in which the film moved with the flanks
                                        without pressure */
    double worst_truncation, worst_truncation_at; /* largest `local`, and its time */
    double distance, renewed; /* distance that the film has moved, m, and time at which this
                                 distance reached 2 a, s */
    int start_unloaded;       /* 1: the history begins without load */
    char why[256];            /* reason of a failure */
} ehl_march;

ff_status ehl_march_create(ehl_march *m, const ehl_history *h, ehl_solver *s, int scheme);
void ehl_march_destroy(ehl_march *m);

ehl_step ehl_instant_step(const ehl_march *m, const ehl_instant *at);
/* Adds the effect of the oil in front of the domain at that instant. */
void ehl_feed_step(const ehl_solver *s, const ehl_instant *at, ehl_step *step);
void ehl_copy_film(ehl_film *to, const ehl_film *from, size_t nodes);
double ehl_thinnest(ehl_march *m, double radius, const ehl_film *film);

/* Returns 1 without load, or if the load is still too small to end the contact loss. The dynamics
   then prescribes the gap (contact-loss.c). */
int ehl_contact_is_lost(const ehl_march *m, const ehl_instant *at);

/* Returns the time in which oil passes through the widest contact of the history at this speed, s;
   at most the duration of the history. */
double ehl_march_passage(const ehl_march *m, double speed);

/* Returns 1 if the newest film carries at least 2 % of the largest load. Below that the grid is too
   coarse for the film, and its errors are ignored. */
int ehl_march_is_loaded(const ehl_march *m);

/* Restarts the difference formula, because the history has a breakpoint at the newest state. */
void ehl_march_breakpoint(ehl_march *m);

/* Computes the coefficients of the time derivative at `time`: c[0] y + c[1] y(state 0) + c[2]
   y(state 1). */
void ehl_march_factors(const ehl_march *m, double time, double c[3]);

/* Computes Lagrange's factors that extrapolate the `count` newest states to `time`; 0 for older
   states. */
void ehl_lagrange_factors(const ehl_march *m, double time, size_t count, double *c);

/* Counts the newest states that one polynomial in time may interpolate: all loaded or all
   unloaded. */
size_t ehl_run_of_states(const ehl_march *m, int loaded, size_t most);

/* Removes the pressure and leaves the oil in place. */
void ehl_remove_pressure(ehl_film *film, const double *mass, size_t nodes);

#endif
