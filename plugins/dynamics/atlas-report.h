/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The atlas as outputs and in words. */
#ifndef FF_DYNAMICS_ATLAS_REPORT_H
#define FF_DYNAMICS_ATLAS_REPORT_H

#include "atlas.h"
#include "motion.h"

/* Reads "p2-1"; 0: no such name. */
int ff_branch_parse(const char *text, ff_branch_name *name);

/* The names of the branches at a speed, with "unstable" behind those that are. */
void ff_atlas_list(const ff_flow *flow, const ff_atlas *atlas, double lambda, char *text,
                   size_t size);

/* Gives the outputs from FF_OUT_ATLAS_FREQUENCY on; `frequency` is the natural one, Hz. */
ff_status ff_atlas_put(const ff_atlas *atlas, const ff_mesh *mesh, double frequency,
                       const ff_host *host);

/* Quality lines: how the curves end, and what the search found. */
void ff_atlas_report(const ff_atlas *atlas, const ff_host *host);

#endif
