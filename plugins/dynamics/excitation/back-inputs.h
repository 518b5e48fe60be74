/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs from the stiffness for the back flanks, which the mean load does not press together. */
#ifndef DYNAMICS_BACK_INPUTS_H
#define DYNAMICS_BACK_INPUTS_H

#include "inputs.h"

/* Checks and reads them. For a model that follows both flanks, adds their track to the excitation
 * and, if a fluctuating force presses both flanks in turn, also the track of free flight. */
ff_status dynamics_back_inputs_read(const ff_host *host, const ff_array *in,
                                    dynamics_inputs *inputs, dynamics_excitation *excitation);

/* Reports which curves the back flanks follow; `share` is the share of the time in which the motion
 * loads them. */
void dynamics_back_flank_line(const ff_host *host, const dynamics_inputs *inputs,
                              const dynamics_excitation *excitation, double share);

#endif
