/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film between two rigid cylinders that roll and approach each other, with an oil of constant
   viscosity. It models the line contact just before separated flanks meet again. With h the
   smallest thickness, R the equivalent radius, u the entrainment speed (u1 + u2)/2, V = -h' the
   speed of approach and b the width, the load W follows from one curve (derived in docs/theory.md,
   "Oil between landing flanks"), w = W h/(eta0 u R b) over beta = (V/u) sqrt(2 R/h). Cavitation
   follows the Reynolds condition: pressure and its gradient are 0 at the end of the film, and the
   pressure is nowhere negative. beta -> infinity: w = 3 pi beta, that is W = 3 sqrt(2) pi eta0 b V
   (R/h)^1.5 beta = 0: w = 4.8950, the wedge alone; beta -> -infinity: w = 128/(27 beta^2) */
#ifndef DYNAMICS_SQUEEZE_LAW_H
#define DYNAMICS_SQUEEZE_LAW_H

enum { DYNAMICS_SQUEEZE_NODES = 1501 };

/* Computes a point of the curve in closed form at delta = pi/2 + atan(X), 0 < delta < pi; the film
   ends at X sqrt(2 R h). beta and w increase with delta. */
void dynamics_squeeze_point(double delta, double *beta, double *w);

/* Table of beta as a function of w: asinh(beta) and its slope over ln w at evenly spaced nodes,
   with cubic interpolation. The error of beta is below 2e-9 (1 + |beta|). Beyond the nodes the
   power laws of the curve are used. */
typedef struct dynamics_squeeze_table {
    double value[DYNAMICS_SQUEEZE_NODES], slope[DYNAMICS_SQUEEZE_NODES];
    double least, beta_least,
        slope_least; /* below w = least, beta continues as a straight line to w < 0 */
} dynamics_squeeze_table;

void dynamics_squeeze_table_build(dynamics_squeeze_table *table);

/* Computes beta and its derivative with respect to w. */
double dynamics_squeeze_beta(const dynamics_squeeze_table *table, double w, double *slope);

/* Returns w of the wedge alone, at beta = 0. */
double dynamics_squeeze_wedge(void);

#endif
