/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One smooth piece in place of many straight lines of a table of k and e. */
#ifndef DYNAMICS_SMOOTH_PIECE_H
#define DYNAMICS_SMOOTH_PIECE_H

#include "spring.h"

/* `spring` NULL: one that does not bend. Fits the longest piece that begins at node `first` and
   ends at `last` or before, and adds its errors to `represented`. Returns the node at which it
   ends; 0: the lines there follow no smooth curve, or are too few to tell. */
size_t dynamics_smooth_piece(const dynamics_excitation *excitation,
                             const dynamics_mesh_curves *curves,
                             const dynamics_spring_nodes *spring, size_t first, size_t last,
                             dynamics_piece *piece, dynamics_representation *represented);

/* The polynomial that meets both ends of a series and its nodes by least squares, over `unit`: its
   coefficients in powers of the phase since the first node. Returns the largest distance from the
   nodes over `unit`; infinite: the nodes are too few. */
double dynamics_smooth_series(const double *phase, const double *value, size_t count, double unit,
                              double coefficients[DYNAMICS_DEGREE + 1]);

#endif
