/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The interface of a solver of one instant, as used by the time marching. */
#ifndef EHL_SOLVER_H
#define EHL_SOLVER_H

#include "reynolds.h"

#include <flankfilm/film.h>

/* Largest numbers of Newton steps: from an extrapolated film, a transported film, the last film,
   and a first guess. */
enum {
    EHL_LIMIT_GUESSED = 12,
    EHL_LIMIT_REPEATED = 30,
    EHL_LIMIT_PLAIN = 25,
    EHL_LIMIT_START = 60
};

typedef struct ehl_counters {
    double newton, krylov, convolutions, factorisations;
    double undecided; /* number of films whose boundary is at a node that can be neither full nor
                         cavitated */
} ehl_counters;

typedef struct ehl_solver {
    const ehl_grid *grid;
    ehl_reynolds *reynolds;
    const double *kernel;   /* from ehl_kernel_fill, one value per node distance */
    double modulus;         /* E', Pa */
    double tolerance;       /* allowed relative error of the film that remains in the solution */
    int no_film;            /* whether the discretisation of another stage returned an invalid
                               film: values that are not finite, or a pressure at the ends */
    int gave_up;            /* whether the discretisation of another stage failed too often */
    const ff_film *outside; /* the discretisation of another stage, for ehl_outside; NULL: none */
    ehl_counters counters;
    double rescaling; /* scaling factor of the pressure at the end of the last solution */
    void *self;
    /* Solves, starting from the given film, whose v must be the deflection of its p, with at most
       `limit` Newton steps. Returns FF_OK, or FF_NOCONV with an unusable film. */
    ff_status (*solve)(struct ehl_solver *s, const ehl_step *step, ehl_film *film, int limit);
    void (*deflect)(struct ehl_solver *s, const double *p, double *v);
    void (*destroy)(struct ehl_solver *s);
    ff_status (*maker)(struct ehl_solver *s); /* function that made this solver */
} ehl_solver;

/* Makes a solver. grid, reynolds, kernel, modulus and tolerance are already set. Returns FF_NOMEM
   or FF_UNSUPPORTED on failure. */
typedef ff_status ehl_solver_maker(ehl_solver *s);

ehl_solver_maker ehl_newton_krylov;
ehl_solver_maker ehl_dense_newton;
ehl_solver_maker ehl_line_relaxation;
ehl_solver_maker ehl_outside;

#endif
