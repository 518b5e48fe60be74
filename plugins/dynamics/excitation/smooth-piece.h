/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits one smooth piece to many straight lines of a table of k and e. */
#ifndef DYNAMICS_SMOOTH_PIECE_H
#define DYNAMICS_SMOOTH_PIECE_H

#include "spring.h"

/* Fits the longest smooth piece that begins at node `first` and ends at node `last` or before, and
   adds its errors to `represented`. If `spring` is NULL, the spring is linear. Returns the node
   where the piece ends, or 0 if the lines there do not follow a smooth curve or are too few to
   decide. */
size_t dynamics_smooth_piece(const dynamics_excitation *excitation,
                             const dynamics_mesh_curves *curves,
                             const dynamics_spring_nodes *spring, size_t first, size_t last,
                             dynamics_piece *piece, dynamics_representation *represented);

/* Fits a polynomial to a series, divided by `unit`: exact at both ends, least squares at the nodes
   between. Sets its coefficients in powers of the phase since the first node. Returns the largest
   distance from the nodes, divided by `unit`, or infinity if there are too few nodes. */
double dynamics_smooth_series(const double *phase, const double *value, size_t count, double unit,
                              double coefficients[DYNAMICS_DEGREE + 1]);

#endif
