/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * One instant of a film against the equations that it is to solve, from the outputs alone: the
 * sums, the deflection and the flows are taken here once more, the flows by other differences than
 * the models'. The run must have asked for "film pressure x time", and with rough flanks none of it
 * holds.
 */
#ifndef TEST_EHL_BALANCE_H
#define TEST_EHL_BALANCE_H

#include "line.h"

/* int p dx, N/m */
double balance_carried(const line *c, size_t k);

/* That, with what the oil in front of the domain carries, less the load of the history, straight
   between its rows, over the largest load; at a jump, less the nearer of both. */
double balance_load(const line *c, size_t k);

/* How far h - x^2/(2 R) - v(p) is from one number h00 for all nodes, over the least film. */
double balance_shape(const line *c, size_t k);

/* The larger of both over `count` instants spread evenly over the results, the last among them.
   Where the load is below 1 % of the largest the flanks may fly: a force of 1 % is no error there.
 */
double balance_of_instants(const line *c, size_t count);

/*
 * What flows into the domain less what flows through a face, over u rho0 h_central, in a steady
 * film: the mean between the first node with 1 % of the highest pressure and the last. The flows
 * are those of central differences, so that what a converged film leaves falls as dx^2.
 */
double balance_flow(const line *c);

/* Cells over the inlet's pressure rise: min(a (3 h R/(2 sqrt(2) a^2))^(2/3), sqrt(2 R h))/dx. */
double balance_cells(const line *c);

/*
 * The same through a history: what has flowed in less what has flowed through a face of the front
 * half and what is stored before it, the largest since the start, over what has passed in all.
 * Flows between two instants are the mean of those of both: it falls as dx^2 and, behind a kink of
 * the load, as dt.
 */
double balance_history(const line *c);

#endif
