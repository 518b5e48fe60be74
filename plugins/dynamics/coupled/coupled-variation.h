/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Derivatives of the state of a pair on elastic bearings with respect to the start state. They are
   integrated along the steps of the motion and across the ends of regimes. */
#ifndef DYNAMICS_COUPLED_VARIATION_H
#define DYNAMICS_COUPLED_VARIATION_H

#include "coupled-field.h"

typedef struct dynamics_variation dynamics_variation;

/* Makes a variation, starting from the unit matrix. `field` must outlive it. `negligible` is the
   error per step. Returns NULL if out of memory. */
dynamics_variation *dynamics_variation_new(dynamics_field *field, double negligible);
void dynamics_variation_free(dynamics_variation *variation);

/* Resets the matrix to the unit matrix. */
void dynamics_variation_start(dynamics_variation *variation);
/* Returns the matrix. Row i contains the derivatives of component i of the state with respect to
   each component at the start. */
const double *dynamics_variation_matrix(const dynamics_variation *variation);

/* Advances the derivatives over a step of duration h from time t, between two states. */
void dynamics_variation_step(dynamics_variation *variation, double t, double h, const double *from,
                             const double *to);
/* Advances the derivatives through a gate that closes, and changes the field to the regime after
   the gate. */
void dynamics_variation_pass_gate(dynamics_variation *variation, int gate, double t,
                                  const double *y);
/* Applies a jump of e by `leap` while the damper of a flank, or the damper in the gap, acts. */
void dynamics_variation_leap(dynamics_variation *variation, int flank, double leap,
                             const dynamics_place *place);

#endif
