/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The error transport equation gives the error of a film, at all nodes of all instants, due to the
 * cells and due to the time steps. Each cause has a linear equation with the matrix of Newton's
 * method,
 *   J e = -tau - contribution of the errors of earlier films to the change in time,
 * with tau the residual that the exact film would leave in the discrete equations (Skeel 1986,
 * Numer. Math. 48; Banks et al. 2012, Comput. Methods Appl. Mech. Eng. 213; docs/theory.md, 12.13).
 */
#ifndef EHL_ERROR_TRANSPORT_H
#define EHL_ERROR_TRANSPORT_H

#include "../equations/march.h"
#include "../solvers/gmres.h"

enum { EHL_BY_CELLS, EHL_BY_STEPS, EHL_CAUSES };

/* Arrays of one cause and of both, and all of them. */
enum {
    EHL_ERROR_ARRAYS = 5 + EHL_STATES,
    EHL_SHARED_ARRAYS = 3,
    EHL_TRANSPORT_ARRAYS = EHL_CAUSES * EHL_ERROR_ARRAYS + EHL_SHARED_ARRAYS
};

/* Errors of the newest film due to one cause: the computed film minus the exact one. */
typedef struct ehl_film_error {
    ehl_answer now, before;   /* before: of the film before it */
    double *h;                /* m */
    double *mass[EHL_STATES]; /* kg/m2, of the newest films, newest first */
} ehl_film_error;

typedef struct ehl_transport {
    double *memory; /* EHL_TRANSPORT_ARRAYS of `nodes` values each */
    size_t nodes;
    double accuracy; /* residual of the linear solutions, over the larger of both errors */
    ehl_film_error of[EHL_CAUSES];
    double *tau, *rows, *flow;
    double last_step; /* s, length of the step before the newest film; 0: none */
    int known;        /* the newest film has errors */
    int lost;         /* 1: the errors were not found once, so that all later ones are not known */
} ehl_transport;

/* FF_NOMEM */
ff_status ehl_transport_create(ehl_transport *t, size_t nodes);
void ehl_transport_destroy(ehl_transport *t);

/* Forgets all errors before another engagement starts. */
void ehl_transport_restart(ehl_transport *t);

/* Finds the errors of the trial, before it becomes the newest state. */
void ehl_transport_step(ehl_march *m);

#endif
