/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The linear system of one Newton step, by GMRES (Saad & Schultz 1986), preconditioned in two
 * levels: a coarse grid for the long waves, banded factors for the others. A product with the
 * Jacobian costs one FFT convolution.
 */
#ifndef EHL_GMRES_H
#define EHL_GMRES_H

#include "../equations/deflection.h"
#include "../equations/solver.h"
#include "band.h"
#include "coarse.h"

/* Most vectors of one linear solution. */
enum { EHL_KRYLOV = 40 };

/* First member of what a solver that uses it calls `self`. */
typedef struct ehl_linear {
    ehl_fft *fft;
    ehl_band *band;
    ehl_coarse *coarse; /* NULL: the band is enough */
    int split;          /* the coarse grid takes part in the current linear solution */
    double *memory;
    double *basis[EHL_KRYLOV + 1], *deflection[EHL_KRYLOV];
    double *product; /* Jacobian times a vector, or the right-hand side */
    double *p_step, *v_step, *h_step, *diagonal, *masked, *left;
    unsigned char *factored_kind, *kind;
    size_t factored_last;
    int factored, factored_loaded;
    int careful; /* rough flanks, or so light a load that the pressure tells little of the film */
    double curvature; /* Newton's method neglects so many times the square of a relative change */
    double suffices;  /* share of the residual that may be left in the end; 0: what was asked for */
    double reached;   /* norm of the residual that the last solution left, over its first */
    double unbalanced; /* flow that it left unbalanced, over that through the contact; 0 without the
                          coarse grid, whose norm alone hides it */
    size_t krylov, krylov_fresh; /* iterations of the last solution, and of the first one after
                                    factorising */
} ehl_linear;

/* FF_NOMEM */
ff_status ehl_linear_create(ehl_solver *s, ehl_linear *w);
void ehl_linear_destroy(ehl_linear *w);

/* Deflection of p, by FFT; a function of the solver. */
void ehl_linear_deflect(ehl_solver *s, const double *p, double *v);

/* Solves for p_step, v_step and *dh00 after the residual and the slopes of the equations.
   FF_NOCONV: a number overflowed. */
ff_status ehl_linear_solve(ehl_solver *s, const ehl_step *step, const ehl_film *film, double *dh00);

/* 1: the last solution reached its accuracy within EHL_KRYLOV vectors, or what suffices where more
   was asked for. */
static inline int ehl_linear_converged(const ehl_linear *w)
{
    return w->krylov < EHL_KRYLOV || w->reached <= w->suffices;
}

/* Factorises anew from the first node whose equation has changed, or all when the factors are
   outdated. */
void ehl_linear_factor(ehl_solver *s, const ehl_step *step, const ehl_film *film);

/* Learns how much Newton's method neglects from a step that follows one of the size `before`, whose
   linear solution left the share `reached`: its own size `now` is what that left. Relative. */
void ehl_linear_learn(ehl_solver *s, double before, double reached, double now);

void ehl_linear_unlearn(ehl_solver *s);

/* Trusts less in what was learned, as a step without a second one. */
void ehl_linear_forget(ehl_solver *s);

/* Whether what is predicted to be left after the step of the last solution is as small as the
   tolerance allows, and of the film `times` as much. The step changed them by these shares. */
int ehl_linear_settles(const ehl_solver *s, double pressure, double film, double times);

/* Whether the last solution left as little of the flow unbalanced as the tolerance allows. What
   ehl_linear_settles predicts goes by the norm of GMRES, which may hide a hundred times as much. */
int ehl_linear_balances(const ehl_solver *s);

/* Returns the pressures of a vector of unknowns. The unknown of a cavitated node is a mass, and
   that of a yielding node a plastic part: both count as 0 here. */
const double *ehl_pressure_part(const ehl_solver *s, const ehl_film *film, const double *v);

/* y += factor x */
void ehl_add(double *restrict y, double factor, const double *restrict x, size_t n);

#endif
