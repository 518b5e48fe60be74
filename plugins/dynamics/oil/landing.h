/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Steps of the motion while no flank is held, with the films of film.h in front of the flanks. A
 * film in a wide gap yields at once: the equations are stiff there. So a step is a collocation at
 * the nodes of Radau (Hairer & Wanner 1996, Solving Ordinary Differential Equations II, section
 * IV.5: Radau IIA), which damps what a step does not resolve, of order 13 at its end. Its length
 * follows from the last coefficients of the films and the speed in Legendre's polynomials.
 */
#ifndef DYNAMICS_LANDING_H
#define DYNAMICS_LANDING_H

#include "../excitation/excitation.h"
#include "film.h"

enum { DYNAMICS_STAGES = 7, DYNAMICS_NODES = DYNAMICS_STAGES + 1 };

/* Columns of a variation: derivatives by the start values of delta, its rate and both films, and by
 * the duration of the mesh cycle at fixed phase. Rows: delta, rate, films. */
enum { DYNAMICS_FILM_ROWS = 4, DYNAMICS_FILM_COLUMNS = 5 };

typedef struct dynamics_radau {
    double node[DYNAMICS_STAGES]; /* in (0, 1], the last one at 1 */
    double a[DYNAMICS_STAGES][DYNAMICS_STAGES], square[DYNAMICS_STAGES][DYNAMICS_STAGES];
    double power[DYNAMICS_NODES][DYNAMICS_NODES]; /* powers of x from values at 0 and the nodes */
} dynamics_radau;

void dynamics_radau_init(dynamics_radau *radau);

/* A step from the phase `at` to `end`. The first number of each series belongs to the start, the
 * others to the nodes. `open` says whether the film of a flank carries; a film that does not is in
 * free flight. */
typedef struct dynamics_landing {
    const dynamics_excitation *excitation;
    const dynamics_piece *piece;
    double at, end, T;
    int open[2];
    double delta[DYNAMICS_NODES], rate[DYNAMICS_NODES], film[2][DYNAMICS_NODES];
    double bend[2][DYNAMICS_NODES]; /* bend of the teeth, q + y */
    double force[DYNAMICS_NODES];   /* force of the teeth on the gears, along delta */
    double doubt;                   /* error of the nodes' polynomials over the allowed error */
    dynamics_approach approach[2][DYNAMICS_STAGES];
    double inverse[DYNAMICS_STAGES][DYNAMICS_STAGES]; /* derivative of the accelerations of the
                                                         stages by the force */
} dynamics_landing;

/* Solves the step from the start values. 0: no solution was found; a shorter step has one. */
int dynamics_landing_solve(const dynamics_radau *radau, dynamics_landing *step);

/* Carries the derivatives over the step. */
void dynamics_landing_vary(const dynamics_radau *radau, const dynamics_landing *step,
                           double column[DYNAMICS_FILM_COLUMNS][DYNAMICS_FILM_ROWS]);

/* Energies of a step. */
typedef struct dynamics_landing_energy {
    double damper, films; /* taken by them */
    double work;          /* supplied by changes of k and e */
    double thickness;     /* part of `work` supplied by the loaded film */
    double drag;          /* taken by friction and rolling */
} dynamics_landing_energy;

dynamics_landing_energy dynamics_landing_energies(const dynamics_radau *radau,
                                                  const dynamics_landing *step);

/* Gives the polynomial through the values as powers of x in [0, 1]. */
void dynamics_landing_polynomial(const dynamics_radau *radau, const double *value, double *power);

#endif
