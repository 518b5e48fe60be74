/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The atlas as outputs and in words. */
#ifndef DYNAMICS_ATLAS_REPORT_H
#define DYNAMICS_ATLAS_REPORT_H

#include "atlas.h"
#include "motion.h"

/* Reads "p2-1"; 0: no such name. */
int dynamics_branch_parse(const char *text, dynamics_branch_name *name);

/* The names of the branches at a speed, with "unstable" behind those that are. */
void dynamics_atlas_list(const dynamics_flow *flow, const dynamics_atlas *atlas, double lambda,
                         char *text, size_t size);

/* Gives the outputs from DYNAMICS_OUT_ATLAS_FREQUENCY on; `frequency` is the natural one, Hz. */
ff_status dynamics_atlas_put(const dynamics_atlas *atlas, const dynamics_excitation *excitation,
                             double frequency, const ff_host *host);

/* Quality lines: how the curves end, what the search found, and which branches there are at a
   speed; `orbit` is the motion that is shown there, NULL: none, or one that does not repeat itself.
 */
void dynamics_atlas_report(const dynamics_flow *flow, const dynamics_atlas *atlas, double lambda,
                           const dynamics_orbit *orbit, const ff_host *host);

#endif
