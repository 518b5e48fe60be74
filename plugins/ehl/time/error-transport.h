/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The error transport equation: what the cells have made of a film, at all nodes of all instants,
 * by a linear equation with the matrix of Newton's method,
 *   J e = -tau - what the errors of the films before it leave in the change in time,
 * with tau the residual that the exact film would leave in the discrete equations (Skeel 1986,
 * Numer. Math. 48; Banks et al. 2012, Comput. Methods Appl. Mech. Eng. 213; docs/theory.md, 12.13).
 */
#ifndef EHL_ERROR_TRANSPORT_H
#define EHL_ERROR_TRANSPORT_H

#include "../equations/march.h"
#include "../solvers/gmres.h"

enum { EHL_TRANSPORT_ARRAYS = 7 + EHL_STATES };

typedef struct ehl_transport {
    double *memory; /* EHL_TRANSPORT_ARRAYS of `nodes` values each */
    size_t nodes;
    double accuracy;          /* residual of the linear solutions, over the errors */
    ehl_answer e;             /* errors of the newest film: the computed film minus the exact one */
    double *h;                /* m */
    double *mass[EHL_STATES]; /* kg/m2, of the newest films, newest first */
    double *tau, *flow;
    double *rows, *rest; /* right-hand side, and what the last solution has left of it */
    double last_step;    /* s, length of the step before the newest film; 0: none */
    double blind; /* m, way of the oil until errors that were not found have left the contact */
    int known;    /* the newest film has errors */
} ehl_transport;

/* FF_NOMEM */
ff_status ehl_transport_create(ehl_transport *t, size_t nodes);
void ehl_transport_destroy(ehl_transport *t);

/* Forgets all errors before another engagement starts. */
void ehl_transport_restart(ehl_transport *t);

/* Finds the errors of the trial, before it becomes the newest state. */
void ehl_transport_step(ehl_march *m);

#endif
