/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The outputs and the quality lines of an atlas. */
#ifndef DYNAMICS_ATLAS_REPORT_H
#define DYNAMICS_ATLAS_REPORT_H

#include "../oscillator/motion.h"
#include "atlas.h"

/* Reads a branch name such as "p2-1". Returns 0 if the text is not a branch name. */
int dynamics_branch_parse(const char *text, dynamics_branch_name *name);

/* Lists the branches that have a motion at the speed lambda (mesh frequency over natural
   frequency). The word "unstable" follows each unstable branch. */
void dynamics_atlas_list(const dynamics_flow *flow, const dynamics_atlas *atlas, double lambda,
                         char *text, size_t size);

/* Writes the outputs from DYNAMICS_OUT_ATLAS_FREQUENCY on; `frequency` is the natural frequency,
   Hz. */
ff_status dynamics_atlas_put(const dynamics_atlas *atlas, const dynamics_excitation *excitation,
                             double frequency, const ff_host *host);

/* Writes the quality lines: how the curves end, what the search found, and which branches exist at
   a speed. `orbit` is the motion shown at that speed; it is NULL if there is none or it is not
   periodic. */
void dynamics_atlas_report(const dynamics_flow *flow, const dynamics_atlas *atlas, double lambda,
                           const dynamics_orbit *orbit, const ff_host *host);

#endif
