/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a stiffness tells of the flanks that the mean load does not press. */
#ifndef DYNAMICS_BACK_INPUTS_H
#define DYNAMICS_BACK_INPUTS_H

#include "inputs.h"

/* Checks and reads them, and adds their track to the excitation of a model that follows both
 * flanks; where a swinging force presses both in turn, that of free flight, too. */
ff_status dynamics_back_inputs_read(const ff_host *host, const ff_array *in,
                                    dynamics_inputs *inputs, dynamics_excitation *excitation);

/* Says which curves the back flanks follow in a motion that loads them for that share of its time.
 */
void dynamics_back_flank_line(const ff_host *host, const dynamics_inputs *inputs,
                              const dynamics_excitation *excitation, double share);

#endif
