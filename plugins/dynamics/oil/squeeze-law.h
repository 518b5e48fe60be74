/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The film between two rigid cylinders that roll and approach each other, with an oil of constant
 * viscosity: the line contact in front of a landing. With h the least thickness, R the equivalent
 * radius, u the entrainment speed (u1 + u2)/2, V = -h' the speed of approach and b the width, the
 * load W follows from one curve (derived in docs/theory.md, "Oil between landing flanks"),
 *
 *   w = W h/(eta0 u R b) over beta = (V/u) sqrt(2 R/h).
 *
 * Cavitation after Reynolds: the pressure ends with no slope and is nowhere negative, which is the
 * solution of the complementarity problem; there is no suction.
 *
 *   beta -> infinity: w = 3 pi beta, that is W = 3 sqrt(2) pi eta0 b V (R/h)^1.5
 *   beta = 0: w = 4.8950, the wedge alone; beta -> -infinity: w = 128/(27 beta^2)
 */
#ifndef DYNAMICS_SQUEEZE_LAW_H
#define DYNAMICS_SQUEEZE_LAW_H

enum { DYNAMICS_SQUEEZE_NODES = 1501 };

/* A point of the curve in closed form, by delta = pi/2 + atan(X), 0 < delta < pi, where X sqrt(2 R
   h) is the place at which the film ends. beta and w rise with delta. */
void dynamics_squeeze_point(double delta, double *beta, double *w);

/* beta over w: asinh(beta) and its slope over ln w at evenly spaced nodes, cubic in between. The
   error of beta is below 2e-9 (1 + |beta|); beyond the nodes the curve has its power laws. */
typedef struct dynamics_squeeze_table {
    double value[DYNAMICS_SQUEEZE_NODES], slope[DYNAMICS_SQUEEZE_NODES];
    double least, beta_least, slope_least; /* w below which beta goes on straight, into w < 0 */
} dynamics_squeeze_table;

void dynamics_squeeze_table_build(dynamics_squeeze_table *table);

/* beta and its derivative by w. */
double dynamics_squeeze_beta(const dynamics_squeeze_table *table, double w, double *slope);

/* w of the wedge alone, beta = 0. */
double dynamics_squeeze_wedge(void);

#endif
