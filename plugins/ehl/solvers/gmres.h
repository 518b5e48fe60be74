/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves the linear system of one Newton step by GMRES (Saad & Schultz 1986) with a two-level
   preconditioner: a coarse grid for long waves and a band matrix for short waves. A product with
   the Jacobian costs one FFT convolution. */
#ifndef EHL_GMRES_H
#define EHL_GMRES_H

#include "../equations/deflection.h"
#include "../equations/solver.h"
#include "band.h"
#include "coarse.h"

/* Largest Krylov dimension of one linear solution. */
enum { EHL_KRYLOV = 40 };

/* A solution of the linear system, Pa and m. v is the deflection of p. */
typedef struct ehl_answer {
    double *p, *v, h00;
} ehl_answer;

/* Work space of the linear solver: the first member of a solver's `self`. */
typedef struct ehl_linear {
    ehl_fft *fft;
    ehl_band *band;
    ehl_coarse *coarse; /* NULL: the band matrix is sufficient */
    int split;          /* 1: the coarse grid is used in the current solution */
    double *memory;
    double *basis[EHL_KRYLOV + 1], *deflection[EHL_KRYLOV];
    double *asked;   /* right-hand side */
    double *product; /* Jacobian times a vector, or the right-hand side */
    double *p_step, *v_step, *h_step, *diagonal, *masked, *left;
    unsigned char *factored_kind, *kind;
    size_t factored_last;
    int factored, factored_loaded;
    int careful;      /* 1: rough flanks, or such a light load that the pressure contains little
                         information about the film */
    double curvature; /* error that Newton's method neglects, over the square of the relative
                         change */
    double suffices; /* share of the residual that is acceptable after EHL_KRYLOV iterations; 0: the
                        requested share */
    double reached;  /* residual norm after the last solution over the norm before it */
    /* imbalance of flow after the last solution, over the flow through the contact; 0 without the
       coarse grid, since the norm shows the imbalance then */
    double unbalanced;
    size_t krylov, krylov_fresh; /* iterations of the last solution, and of the first solution after
                                    a factorisation */
} ehl_linear;

/* Returns FF_OK or FF_NOMEM. */
ff_status ehl_linear_create(ehl_solver *s, ehl_linear *w);
void ehl_linear_destroy(ehl_linear *w);

/* Computes the deflection of p by FFT; used as `deflect` of a solver. */
void ehl_linear_deflect(ehl_solver *s, const double *p, double *v);

/* Solves for p_step, v_step and *dh00. The residual and the derivatives of the equations must have
   been computed. Returns FF_NOCONV if a number overflowed. */
ff_status ehl_linear_solve(ehl_solver *s, const ehl_step *step, const ehl_film *film, double *dh00);

/* Solves J (e->p, e->h00) = (rows, 0) with the current derivatives of the equations, starting from
   the values in `e`, until the error is at most `share` of the answer. The last row is the balance
   of the load. `rest` receives the remaining residual. The state of Newton's method and the
   counters are not changed. Returns FF_NOCONV if a number overflowed or the accuracy was not
   reached. */
ff_status ehl_linear_answer(ehl_solver *s, const ehl_step *step, const ehl_film *film,
                            const double *rows, double share, ehl_answer *e, double *rest);

/* Returns 1 if the last solution reached its accuracy within EHL_KRYLOV vectors, or reached
 * `suffices`. */
static inline int ehl_linear_converged(const ehl_linear *w)
{
    return w->krylov < EHL_KRYLOV || w->reached <= w->suffices;
}

/* Factorises from the first node whose equation has changed, or for all nodes if the factors are
   outdated. */
void ehl_linear_factor(ehl_solver *s, const ehl_step *step, const ehl_film *film);

/* Adapts the curvature from two successive steps. The first step had the relative change `before`,
   and the share `reached` of its residual remained. The second step has the relative change
   `now`. */
void ehl_linear_learn(ehl_solver *s, double before, double reached, double now);

void ehl_linear_unlearn(ehl_solver *s);

/* Raises the curvature slightly after a step that was sufficient by itself. */
void ehl_linear_forget(ehl_solver *s);

/* Returns whether the predicted error after the last step is within the tolerance for the pressure,
   and within `times` the tolerance for the film. `pressure` and `film` are the relative changes of
   pressure and film in this step. */
int ehl_linear_settles(const ehl_solver *s, double pressure, double film, double times);

/* Returns whether the last solution left the flow balanced within the tolerance. ehl_linear_settles
   relies on GMRES's norm, which may hide an imbalance a hundred times as large. */
int ehl_linear_balances(const ehl_solver *s);

/* Returns the pressures of a vector of unknowns: 0 at cavitated nodes, whose unknown is a mass, and
   at yielding nodes, whose unknown is a plastic part. */
const double *ehl_pressure_part(const ehl_solver *s, const ehl_film *film, const double *v);

/* Adds factor x to y. */
void ehl_add(double *restrict y, double factor, const double *restrict x, size_t n);

#endif
