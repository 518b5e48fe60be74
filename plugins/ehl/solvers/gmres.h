/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The linear system of one Newton step by GMRES (Saad & Schultz 1986) with a preconditioner of two
 * levels: a coarse grid for long waves and banded factors for the others. A product with the
 * Jacobian costs one FFT convolution. */
#ifndef EHL_GMRES_H
#define EHL_GMRES_H

#include "../equations/deflection.h"
#include "../equations/solver.h"
#include "band.h"
#include "coarse.h"

/* Most vectors of one linear solution. */
enum { EHL_KRYLOV = 40 };

/* A solution of the linear system, Pa and m; v is the deflection of p. */
typedef struct ehl_answer {
    double *p, *v, h00;
} ehl_answer;

/* Work space of the linear solver: the first member of a solver's `self`. */
typedef struct ehl_linear {
    ehl_fft *fft;
    ehl_band *band;
    ehl_coarse *coarse; /* NULL: the band suffices */
    int split;          /* 1: the coarse grid takes part in the current solution */
    double *memory;
    double *basis[EHL_KRYLOV + 1], *deflection[EHL_KRYLOV];
    double *asked;   /* right-hand side */
    double *product; /* Jacobian times a vector, or the right-hand side */
    double *p_step, *v_step, *h_step, *diagonal, *masked, *left;
    unsigned char *factored_kind, *kind;
    size_t factored_last;
    int factored, factored_loaded;
    int careful; /* 1: rough flanks, or so light a load that the pressure says little about the film
                  */
    double
        curvature; /* Newton's method neglects this multiple of the square of a relative change */
    double
        suffices; /* share of the residual that is acceptable in the end; 0: the share asked for */
    double reached;    /* residual norm after the last solution over that before it */
    double unbalanced; /* imbalance of flow after the last solution, over the flow through the
                          contact; 0 without the coarse grid, which alone hides it from the norm */
    size_t krylov, krylov_fresh; /* iterations of the last solution, and of the first one after a
                                    factorisation */
} ehl_linear;

/* Returns FF_OK or FF_NOMEM. */
ff_status ehl_linear_create(ehl_solver *s, ehl_linear *w);
void ehl_linear_destroy(ehl_linear *w);

/* Computes the deflection of p by FFT; implements the solver's `deflect`. */
void ehl_linear_deflect(ehl_solver *s, const double *p, double *v);

/* Solves for p_step, v_step and *dh00, after the residual and the derivatives of the equations.
 * FF_NOCONV: a number overflowed. */
ff_status ehl_linear_solve(ehl_solver *s, const ehl_step *step, const ehl_film *film, double *dh00);

/* Solves J (e->p, e->h00) = (rows, 0) with the derivatives that the equations have now, starting
 * from the values in `e`, until an error of this share of the answer is left. The last row is the
 * balance of the load. Fills in what is left of `rows`. Leaves the state of Newton's method and the
 * counters as they were. FF_NOCONV: a number overflowed, or the accuracy was not reached. */
ff_status ehl_linear_answer(ehl_solver *s, const ehl_step *step, const ehl_film *film,
                            const double *rows, double share, ehl_answer *e, double *rest);

/* Returns 1 if the last solution reached its accuracy within EHL_KRYLOV vectors, or reached
 * `suffices`. */
static inline int ehl_linear_converged(const ehl_linear *w)
{
    return w->krylov < EHL_KRYLOV || w->reached <= w->suffices;
}

/* Factorises from the first node whose equation has changed, or all nodes if the factors are
 * outdated. */
void ehl_linear_factor(ehl_solver *s, const ehl_step *step, const ehl_film *film);

/* Learns the curvature from two steps in a row: the first had the size `before` and left the share
 * `reached` of its residual, and the second has the size `now`. Sizes are relative changes. */
void ehl_linear_learn(ehl_solver *s, double before, double reached, double now);

void ehl_linear_unlearn(ehl_solver *s);

/* Raises the curvature a little, after a step that was enough by itself. */
void ehl_linear_forget(ehl_solver *s);

/* Returns whether the predicted error after the last solution's step is within the tolerance: of
 * the pressure, and within `times` the tolerance of the film. Both arguments are relative changes
 * by the step. */
int ehl_linear_settles(const ehl_solver *s, double pressure, double film, double times);

/* Returns whether the last solution left the flow balanced to the tolerance. The prediction of
 * ehl_linear_settles relies on GMRES's norm, which may hide a hundred times as much. */
int ehl_linear_balances(const ehl_solver *s);

/* Returns the pressures in a vector of unknowns. The unknown of a cavitated node is a mass and that
 * of a yielding node a plastic part; both count as 0 here. */
const double *ehl_pressure_part(const ehl_solver *s, const ehl_film *film, const double *v);

/* y += factor x */
void ehl_add(double *restrict y, double factor, const double *restrict x, size_t n);

#endif
