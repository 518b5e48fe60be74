/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the film through time: a steady start, then implicit steps that are cut where they
   fail. */
#ifndef EHL_TIME_STEPPER_H
#define EHL_TIME_STEPPER_H

#include "history.h"
#include "solver.h"
#include "surface.h"

enum { EHL_EULER = 0, EHL_BDF2 = 1, EHL_STATES = 3 };
/* Multiple of the contact film below which asperities nearly touch, and hold the film. */
enum { EHL_NEAR_CONTACT = 2 };

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

/* Starts with the steady film of the first instant. Without load there it is the film of a light
   load, and at rest that of a slow motion, or the gap full of oil. */
ff_status ehl_march_start(ehl_march *m);

/* Starts with the steady film of that time, between smooth flanks. */
ff_status ehl_march_start_at(ehl_march *m, double time);

/* Forgets the film before another engagement starts; the counters go on. */
void ehl_march_restart(ehl_march *m);

/* Advances to `time`, in one step unless it fails. FF_OK, or FF_NOCONV with `why`. */
ff_status ehl_march_to(ehl_march *m, double time);

/* Tries one implicit step to that instant: leaves the film in `trial` and its truncation in
   `local`. */
ff_status ehl_march_try(ehl_march *m, const ehl_instant *at);

/* Makes the trial the newest state. */
void ehl_march_accept(ehl_march *m);

/* Serves where not even the shortest step to `at` converges: while the contact is lost the film
   follows the prescribed gap without pressure. FF_OK, or FF_NOCONV with `why`. */
ff_status ehl_march_without_load(ehl_march *m, const ehl_instant *at);

/* Starts the difference formula anew: the history has a breakpoint at the newest state. */
void ehl_march_breakpoint(ehl_march *m);

/* Returns the largest |local| of all nodes. */
double ehl_march_truncation(const ehl_march *m);

/* Returns 1 when the film thins so fast in the trial, or changes so much as the contact opens or
   closes, that the step should be cut. */
int ehl_march_step_too_large(const ehl_march *m);

/* Returns the time in which the film passes the widest contact of the history at that speed, s; no
   more than the whole history. */
double ehl_march_passage(const ehl_march *m, double speed);

/* Returns 1 when the newest film carries 2 % of the largest load or more. Below that the grid is
   too coarse for the film, and its errors do not count. */
int ehl_march_is_loaded(const ehl_march *m);

/* Returns 1 without load, or when the load is still too small to end a contact loss: the dynamics
   prescribes the gap then (contact-loss.c). */
int ehl_contact_is_lost(const ehl_march *m, const ehl_instant *at);

/* Fills `film` with a first guess of the steady film under `at` whose least thickness is
   `thinnest`. */
void ehl_first_guess(ehl_solver *s, const ehl_instant *at, double modulus, double thinnest,
                     ehl_film *film);

/* What start.c, contact-loss.c, advection.c, truncation.c and step-control.c share with
   time-stepper.c. */

/* Most Newton steps from an extrapolated film, a carried film, the last film, and a first guess. */
enum {
    EHL_LIMIT_GUESSED = 12,
    EHL_LIMIT_REPEATED = 30,
    EHL_LIMIT_PLAIN = 25,
    EHL_LIMIT_START = 60
};

/* The change in time at `time` is c[0] y + c[1] y(state 0) + c[2] y(state 1). */
void ehl_march_factors(const ehl_march *m, double time, double c[3]);

/* Computes masses and gaps of the trial, whose film and step are set. */
void ehl_march_update_mass(ehl_march *m);

/* Orients the nodes along the entrainment of `at` and places the rough flanks as they stand
   then. */
void ehl_march_place(ehl_march *m, const ehl_instant *at);

/* Rough flanks: sets the trial to the last film, carried along with the oil to `at`. */
void ehl_advect_film(ehl_march *m, const ehl_instant *at);

/* Sets `to` to what the state has, `each` values per node, moved with the oil to the instant that
   is placed. */
void ehl_advect_values(const ehl_march *m, const ehl_state *s, size_t each, const double *from,
                       double *to);

/* The node of an earlier state that the oil at node i was at. */
size_t ehl_upstream_node(const ehl_march *m, const ehl_state *s, size_t i);

/* Returns the masses of the last two films, moved with the oil to the instant that is placed. */
void ehl_advect_mass(ehl_march *m, const double **one, const double **two);

/* Rough flanks: returns the cells by which the oil may move in a step: one, or half the inlet of an
   asperity where asperities are in contact or nearly so. */
double ehl_largest_advection(const ehl_march *m);

/* Lagrange's factors that extrapolate the `count` newest states to `time`; 0 for older states. */
void ehl_lagrange_factors(const ehl_march *m, double time, size_t count, double *c);

/* Counts the newest states, loaded or all unloaded, that a polynomial in time may go through. */
size_t ehl_run_of_states(const ehl_march *m, int loaded, size_t most);

/* Estimates the truncation of the step to the trial, in `local`. */
void ehl_estimate_truncation(ehl_march *m);

/* Moves the accumulated truncation on with the film by `distance` and adds that of the trial. */
void ehl_advect_error(ehl_march *m, double distance);

ehl_step ehl_instant_step(const ehl_march *m, const ehl_instant *at);
void ehl_copy_film(ehl_film *to, const ehl_film *from, size_t nodes);
double ehl_thinnest(ehl_march *m, double radius, const ehl_film *film);

/* Solves the trial for `step`; without load at the gap of `at`. */
ff_status ehl_solve_trial(ehl_march *m, ehl_step *step, const ehl_instant *at);

/* Solves it while the contact is lost: chooses between the prescribed gap and a balance of
   forces. */
ff_status ehl_solve_contact_loss(ehl_march *m, ehl_step *step, const ehl_instant *at);

/* Removes the pressure and leaves the oil where it is. */
void ehl_remove_pressure(ehl_film *film, const double *mass, size_t nodes);

#endif
