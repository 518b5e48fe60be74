/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the time marching asks of a solver of one instant. */
#ifndef FF_EHL_SOLVER_H
#define FF_EHL_SOLVER_H

#include "reynolds.h"

typedef struct ff_tally {
    double newton, krylov, convolutions, factorisations;
    double undecided; /* films whose end lies at a node that is to be neither wet nor dry */
} ff_tally;

typedef struct ff_solver {
    const ff_grid *grid;
    ff_reynolds *reynolds;
    const double *kernel; /* ff_kernel_fill, one value per node distance */
    double tolerance;     /* relative change of pressure in the last step */
    ff_tally tally;
    double rescaling; /* of the pressure to its load, at the end of the last solution */
    void *self;
    /* Solves from the film given, whose v must be the deflection of its p; at most `limit` Newton
       steps. FF_OK, or FF_NOCONV with the film in no useful state. */
    ff_status (*solve)(struct ff_solver *s, const ff_step *step, ff_film *film, int limit);
    void (*deflect)(struct ff_solver *s, const double *p, double *v);
    void (*destroy)(struct ff_solver *s);
    ff_status (*maker)(struct ff_solver *s); /* of this one */
} ff_solver;

/* A solver on grid, reynolds, kernel and tolerance, which are set; FF_NOMEM. */
typedef ff_status ff_solver_maker(ff_solver *s);

ff_solver_maker ff_newton_krylov;
ff_solver_maker ff_dense_newton;
ff_solver_maker ff_line_relaxation;

#endif
