/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All periodic motions over a range of mesh frequencies. The curves of curve.h are divided at their
   folds into branches, so that a branch has at most one motion at a speed. A branch is named
   p<period>-<n>. Numbers follow the order of discovery: first from the low end of the range, then
   from its high end, then at period doublings, then by the search from scattered starts. */
#ifndef DYNAMICS_ATLAS_H
#define DYNAMICS_ATLAS_H

#include "curve.h"

/* Most mesh cycles in which a start of the search may settle. */
enum { DYNAMICS_SEARCH_CYCLES = 80 };

/* Computes start number `serial` of a sequence that evenly fills the region of states that motions
   visit. */
void dynamics_search_start(const dynamics_excitation *excitation, size_t serial, double x[2]);

typedef struct dynamics_atlas_request {
    double low, high; /* range of lambda */
    double step;      /* see dynamics_continuation_range.step */
    int max_period;
    size_t speeds, starts; /* number of starts of the search, and of the speeds at which they start;
                              0: no search */
    int moments;           /* 1: the rms of the motion is computed for each point */
} dynamics_atlas_request;

typedef struct dynamics_branch_name {
    int period, number;
} dynamics_branch_name;

typedef struct dynamics_atlas_branch {
    dynamics_branch_name name;
    size_t curve, first, last; /* index of the curve, and of the first and the last point of the
                                  branch on it; the point of a fold belongs to both branches */
    double low, high;          /* range of lambda */
    int stable;                /* 0: stable at no point, 1: at some points, 2: at all points */
} dynamics_atlas_branch;

typedef struct dynamics_atlas {
    dynamics_curve *curves;
    size_t curve_count;
    dynamics_atlas_branch *branches;
    size_t branch_count;
    size_t starts, settled, unbounded; /* numbers of starts of the search: all, those that settled,
                                          those that grew without bound */
    size_t searched, met_once; /* number of curves that the search added, and number of curves to
                                  which only one start led */
} dynamics_atlas;

ff_status dynamics_atlas_build(const dynamics_flow *flow, const dynamics_atlas_request *request,
                               const ff_host *host, dynamics_atlas *atlas);
void dynamics_atlas_free(dynamics_atlas *atlas);

/* Returns the branch of that name, or NULL. */
const dynamics_atlas_branch *dynamics_atlas_find(const dynamics_atlas *atlas,
                                                 dynamics_branch_name name);

/* Finds the motion of a branch at a speed. Returns 0 if there is none. */
int dynamics_atlas_orbit(const dynamics_flow *flow, const dynamics_atlas *atlas,
                         const dynamics_atlas_branch *branch, double lambda, dynamics_orbit *orbit);

/* Returns the branch that contains an orbit, or NULL. */
const dynamics_atlas_branch *dynamics_atlas_locate(const dynamics_flow *flow,
                                                   const dynamics_atlas *atlas,
                                                   const dynamics_orbit *orbit);

#endif
