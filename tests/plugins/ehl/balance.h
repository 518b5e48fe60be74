/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks whether the outputs of a film model satisfy the equations of the film at an instant. The
   load, the deflection and the flows are computed here again, the flows with other differences than
   in the models. The run must request "film pressure x time". The functions are valid for smooth
   flanks only. */
#ifndef TEST_EHL_BALANCE_H
#define TEST_EHL_BALANCE_H

#include "line.h"

/* int p dx, N/m */
double balance_carried(const line *c, size_t k);

/* Returns the load that the film carries, including the oil in front of the domain, minus the load
   of the history, over the largest load. The load of the history is interpolated linearly; at a
   jump, the nearer of both loads is taken. */
double balance_load(const line *c, size_t k);

/* Returns by how much h - x^2/(2 R) - v(p), which should be h00 at every node, varies over the
   nodes, over the smallest film thickness. v: deflection. */
double balance_shape(const line *c, size_t k);

/* Returns the largest of balance_load and balance_shape over `count` evenly spaced instants,
   including the last. Where the load is below 1 % of the largest load, the flanks may separate: a
   difference of 1 % in the load is no error there. */
double balance_of_instants(const line *c, size_t count);

/* Returns, for a steady film, the mass flow into the domain minus the flow through a face, over u
   rho0 h_central, as the mean from the first to the last node with at least 1 % of the highest
   pressure. Since the flows come from central differences, the result of a converged film decreases
   as dx^2. */
double balance_flow(const line *c);

/* Returns the number of cells over which the pressure rises in the inlet: min(a (3 h R/(2 sqrt(2)
   a^2))^(2/3), sqrt(2 R h))/dx. */
double balance_cells(const line *c);

/* Returns the error of the mass balance over a history: the mass that has flowed into the domain,
   minus the mass that has flowed through a face in the front half, minus the increase of mass
   between inlet and face; the largest value since the start, over the total mass that has passed.
   The flow between two instants is the mean of their flows: the result decreases as dx^2 and, after
   a kink of the load, as dt. */
double balance_history(const line *c);

#endif
