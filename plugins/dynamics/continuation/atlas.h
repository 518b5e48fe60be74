/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All periodic motions over a range of mesh frequencies. The curves of curve.h are cut at their
 * folds into branches, so that a branch has at most one motion at a speed. A branch is named
 * p<period>-<n>. Numbers follow the order of discovery: from the low end of the range, from its
 * high end, at period doublings, and by the search from scattered starts. */
#ifndef DYNAMICS_ATLAS_H
#define DYNAMICS_ATLAS_H

#include "curve.h"

/* Mesh cycles in which a start of the search may settle. */
enum { DYNAMICS_SEARCH_CYCLES = 80 };

/* Gives start number `serial` of a sequence that fills evenly the region of states that motions
 * visit. */
void dynamics_search_start(const dynamics_excitation *excitation, size_t serial, double x[2]);

typedef struct dynamics_atlas_request {
    double low, high; /* lambda */
    double step;      /* as dynamics_continuation_range.step */
    int max_period;
    size_t speeds,
        starts;  /* starts of the search and the speeds that they are spread over; 0: no search */
    int moments; /* 1: each point gets its rms */
} dynamics_atlas_request;

typedef struct dynamics_branch_name {
    int period, number;
} dynamics_branch_name;

typedef struct dynamics_atlas_branch {
    dynamics_branch_name name;
    size_t curve, first, last; /* first and last point, both included; the point of a fold belongs
                                  to both branches */
    double low, high;          /* lambda */
    int stable;                /* 0: stable at no point, 1: at some, 2: at all */
} dynamics_atlas_branch;

typedef struct dynamics_atlas {
    dynamics_curve *curves;
    size_t curve_count;
    dynamics_atlas_branch *branches;
    size_t branch_count;
    size_t starts, settled, unbounded; /* of the search */
    size_t searched,
        met_once; /* curves that the search added, and those of them that a single start met */
} dynamics_atlas;

ff_status dynamics_atlas_build(const dynamics_flow *flow, const dynamics_atlas_request *request,
                               const ff_host *host, dynamics_atlas *atlas);
void dynamics_atlas_free(dynamics_atlas *atlas);

/* Returns the branch of that name, or NULL. */
const dynamics_atlas_branch *dynamics_atlas_find(const dynamics_atlas *atlas,
                                                 dynamics_branch_name name);

/* Finds the motion of a branch at a speed. 0: there is none. */
int dynamics_atlas_orbit(const dynamics_flow *flow, const dynamics_atlas *atlas,
                         const dynamics_atlas_branch *branch, double lambda, dynamics_orbit *orbit);

/* Returns the branch that an orbit lies on, or NULL. */
const dynamics_atlas_branch *dynamics_atlas_locate(const dynamics_flow *flow,
                                                   const dynamics_atlas *atlas,
                                                   const dynamics_orbit *orbit);

#endif
