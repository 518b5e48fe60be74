/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs from the stiffness for the back flanks, opposite to the flanks that carry the mean
   load. */
#ifndef DYNAMICS_BACK_INPUTS_H
#define DYNAMICS_BACK_INPUTS_H

#include "inputs.h"

/* Checks and reads these inputs. For a model that computes both flanks, adds the track of the back
   flanks to the excitation and, if a fluctuating force presses both flanks in turn, also the track
   of free flight (tracks.h). */
ff_status dynamics_back_inputs_read(const ff_host *host, const ff_array *in,
                                    dynamics_inputs *inputs, dynamics_excitation *excitation);

/* Reports which curves are used for the back flanks; `share` is the share of the time in which the
   motion loads them. */
void dynamics_back_flank_line(const ff_host *host, const dynamics_inputs *inputs,
                              const dynamics_excitation *excitation, double share);

#endif
