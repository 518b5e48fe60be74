/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps of the motion while no flank is held, with the films of film.h between the flanks. A film
   in a wide gap reacts without delay, so the equations are stiff there. A step is therefore a
   collocation at the Radau nodes (Hairer & Wanner 1996, Solving Ordinary Differential Equations II,
   section IV.5: Radau IIA). It damps components that the step does not resolve, and its order at
   the end is 13. The step length follows from the last Legendre coefficients of the films and of
   the speed. */
#ifndef DYNAMICS_LANDING_H
#define DYNAMICS_LANDING_H

#include "../excitation/excitation.h"
#include "film.h"

enum { DYNAMICS_STAGES = 7, DYNAMICS_NODES = DYNAMICS_STAGES + 1 };

/* The matrix of derivatives. Columns: with respect to the start values of delta, its rate and both
   films, and to the duration of the mesh cycle at fixed phase. Rows: delta, rate, films. */
enum { DYNAMICS_FILM_ROWS = 4, DYNAMICS_FILM_COLUMNS = 5 };

typedef struct dynamics_radau {
    double node[DYNAMICS_STAGES]; /* in (0, 1], the last one at 1 */
    double a[DYNAMICS_STAGES][DYNAMICS_STAGES], square[DYNAMICS_STAGES][DYNAMICS_STAGES];
    /* coefficients in powers of x from the values at 0 and at the nodes */
    double power[DYNAMICS_NODES][DYNAMICS_NODES];
} dynamics_radau;

void dynamics_radau_init(dynamics_radau *radau);

/* A step from the phase `at` to `end`. The first number of each series belongs to the start, the
   others to the nodes. `open` is 1 for a flank whose film carries load. Other films are in free
   flight. */
typedef struct dynamics_landing {
    const dynamics_excitation *excitation;
    const dynamics_piece *piece;
    double at, end, T;
    int open[2];
    double delta[DYNAMICS_NODES], rate[DYNAMICS_NODES], film[2][DYNAMICS_NODES];
    double bend[2][DYNAMICS_NODES]; /* deflection of the teeth, q + y */
    double force[DYNAMICS_NODES];   /* force of the teeth on the gears, in the direction of delta */
    double doubt;                   /* estimated error of the polynomials through the nodes, over
                                       the allowed error */
    dynamics_approach approach[2][DYNAMICS_STAGES];
    /* derivative of the accelerations at the stages with respect to the force */
    double inverse[DYNAMICS_STAGES][DYNAMICS_STAGES];
} dynamics_landing;

/* Solves the step from the start values. Returns 0 if no solution was found; a shorter step may
   have one. */
int dynamics_landing_solve(const dynamics_radau *radau, dynamics_landing *step);

/* Advances the derivatives over the step. */
void dynamics_landing_vary(const dynamics_radau *radau, const dynamics_landing *step,
                           double column[DYNAMICS_FILM_COLUMNS][DYNAMICS_FILM_ROWS]);

/* Energies exchanged in a step. */
typedef struct dynamics_landing_energy {
    double damper, films; /* energies taken by the damper and by the films */
    double work;          /* energy supplied by changes of k and e */
    double thickness;     /* part of `work` supplied by the loaded film */
    double drag;          /* energy taken by friction and rolling resistance */
} dynamics_landing_energy;

dynamics_landing_energy dynamics_landing_energies(const dynamics_radau *radau,
                                                  const dynamics_landing *step);

/* Computes the coefficients, in powers of x in [0, 1], of the polynomial through the values. */
void dynamics_landing_polynomial(const dynamics_radau *radau, const double *value, double *power);

#endif
