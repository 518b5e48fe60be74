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

/* Gives a point of the curve in closed form at delta = pi/2 + atan(X), 0 < delta < pi; the film
 * ends at X sqrt(2 R h). beta and w rise with delta. */
void dynamics_squeeze_point(double delta, double *beta, double *w);

/* Table of beta over w: asinh(beta) and its slope over ln w at evenly spaced nodes, cubic in
 * between. The error of beta is below 2e-9 (1 + |beta|). The power laws of the curve hold beyond
 * the nodes. */
typedef struct dynamics_squeeze_table {
    double value[DYNAMICS_SQUEEZE_NODES], slope[DYNAMICS_SQUEEZE_NODES];
    double least, beta_least,
        slope_least; /* below this w, beta continues as a straight line to w < 0 */
} dynamics_squeeze_table;

void dynamics_squeeze_table_build(dynamics_squeeze_table *table);

/* Gives beta and its derivative by w. */
double dynamics_squeeze_beta(const dynamics_squeeze_table *table, double w, double *slope);

/* Returns w of the wedge alone, at beta = 0. */
double dynamics_squeeze_wedge(void);

#endif
