/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The outputs and the quality lines of an atlas. */
#ifndef DYNAMICS_ATLAS_REPORT_H
#define DYNAMICS_ATLAS_REPORT_H

#include "../oscillator/motion.h"
#include "atlas.h"

/* Reads a name as "p2-1"; 0: it is none. */
int dynamics_branch_parse(const char *text, dynamics_branch_name *name);

/* Lists the branches that have a motion at a speed, with "unstable" behind those that are. */
void dynamics_atlas_list(const dynamics_flow *flow, const dynamics_atlas *atlas, double lambda,
                         char *text, size_t size);

/* Gives the outputs from DYNAMICS_OUT_ATLAS_FREQUENCY on; `frequency` is the natural one, Hz. */
ff_status dynamics_atlas_put(const dynamics_atlas *atlas, const dynamics_excitation *excitation,
                             double frequency, const ff_host *host);

/* The quality lines: how the curves end, what the search found, and which branches there are at a
   speed. `orbit` is the motion that is shown there; NULL: there is none, or it does not repeat
   itself. */
void dynamics_atlas_report(const dynamics_flow *flow, const dynamics_atlas *atlas, double lambda,
                           const dynamics_orbit *orbit, const ff_host *host);

#endif
