/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * All periodic motions over a range of mesh frequencies. The curves of curve.h are cut at their
 * folds into branches, each of which holds at most one motion at any speed. A branch is called
 * p<period>-<n>, numbered in the order of discovery: from the low end of the range, from the high
 * end, where periods double, and from the search by random starts.
 */
#ifndef FF_DYNAMICS_ATLAS_H
#define FF_DYNAMICS_ATLAS_H

#include "curve.h"

enum { FF_SEARCH_CYCLES = 80 }; /* that a start of the search may take to settle */

/* Start number `serial` of those that spread evenly over the states that matter. */
void ff_search_start(const ff_mesh *mesh, size_t serial, double x[2]);

typedef struct ff_atlas_request {
    double low, high; /* lambda */
    double step;
    int max_period;
    size_t speeds, starts; /* of the search; 0: none */
    int moments;
} ff_atlas_request;

typedef struct ff_branch_name {
    int period, number;
} ff_branch_name;

typedef struct ff_atlas_branch {
    ff_branch_name name;
    size_t curve, first, last; /* points, both included; the fold between two belongs to both */
    double low, high;          /* lambda */
    int stable;                /* points at which it is stable: 0 none, 1 some, 2 all */
} ff_atlas_branch;

typedef struct ff_atlas {
    ff_curve *curves;
    size_t curve_count;
    ff_atlas_branch *branches;
    size_t branch_count;
    size_t starts, settled, unbounded; /* of the search */
} ff_atlas;

ff_status ff_atlas_build(const ff_flow *flow, const ff_atlas_request *request, const ff_host *host,
                         ff_atlas *atlas);
void ff_atlas_free(ff_atlas *atlas);

/* The branch of that name, or NULL. */
const ff_atlas_branch *ff_atlas_find(const ff_atlas *atlas, ff_branch_name name);

/* The motion of a branch at a speed; 0: none there. */
int ff_atlas_orbit(const ff_flow *flow, const ff_atlas *atlas, const ff_atlas_branch *branch,
                   double lambda, ff_orbit *orbit);

/* The branch that an orbit lies on, or NULL. */
const ff_atlas_branch *ff_atlas_locate(const ff_flow *flow, const ff_atlas *atlas,
                                       const ff_orbit *orbit);

#endif
