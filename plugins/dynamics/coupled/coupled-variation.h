/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a motion of a pair on its bearings changes with its start: the derivatives of the state by
 * that at the start, carried along the steps of the motion and across the ends of regimes. */
#ifndef DYNAMICS_COUPLED_VARIATION_H
#define DYNAMICS_COUPLED_VARIATION_H

#include "coupled-field.h"

typedef struct dynamics_variation dynamics_variation;

/* `field` must outlive it; `negligible` is the error of a step. NULL: out of memory. */
dynamics_variation *dynamics_variation_new(dynamics_field *field, double negligible);
void dynamics_variation_free(dynamics_variation *variation);

/* No change yet: the unit matrix. */
void dynamics_variation_start(dynamics_variation *variation);
/* Row i holds the derivatives of component i of the state, by each component at the start. */
const double *dynamics_variation_matrix(const dynamics_variation *variation);

/* Follows a step of the motion, of duration h from time t, between two states. */
void dynamics_variation_step(dynamics_variation *variation, double t, double h, const double *from,
                             const double *to);
/* Passes a gate that closes there, and moves the field on to the regime behind it. */
void dynamics_variation_pass_gate(dynamics_variation *variation, int gate, double t,
                                  const double *y);
/* A jump of e by `leap` while the damper of a flank (or in the gap) acts. */
void dynamics_variation_leap(dynamics_variation *variation, int flank, double leap,
                             const dynamics_place *place);

#endif
