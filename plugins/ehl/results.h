/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is kept of the film at each time, and how far it can be trusted. */
#ifndef FF_EHL_RESULTS_H
#define FF_EHL_RESULTS_H

#include "balance.h"
#include "engagements.h"
#include "march.h"
#include "model.h"

/* Rows of equal width; their number is known at the end. */
typedef struct ff_table {
    double *data;
    size_t width, count, room;
} ff_table;

typedef struct ff_results {
    const ff_host *host;
    ff_balance balance;
    uint64_t wanted;
    size_t nodes;
    double boundary_friction;
    double roughness;                      /* of both flanks, 0: unknown */
    ff_table series, field[FF_EHL_FIELDS]; /* width 0: not wanted */
    double *row;                           /* of the series, being filled in */
    double *tau, *ln_eta, *memory;
    double lowest, lowest_at, highest, least_lambda;
    ff_lowest engagements;
    double worst_load, worst_mass, worst_complement, lost_force;
    double least_resolution, least_inlet, worst_starvation;
    double outlet_load, worst_outlet;                       /* mean over a passage; its largest */
    double worst_in_time, worst_in_space;                   /* errors of h_min, relative */
    double worst_central_in_time, worst_central_in_space;   /* and of h_central */
    double worst_peak;                                      /* error of p_max by the cells */
    double worst_lift, widest_gap;                          /* in flight, m */
    double share_sum, ratio_sum, trapped_sum, worst_supply; /* of rough, loaded instants */
    double yield_sum, deepest, worst_yield;                 /* the same; deepest: plastic part, m */
    size_t loaded;
    double tail_share; /* of the pressure flow's loss, in front of the domain */
    size_t starved;    /* instants without one: the domain begins dry */
    double undecided;  /* of the solver's, when the mass was recorded last */
    int out_of_law, rough;
} ff_results;

ff_status ff_results_create(ff_results *r, const ff_host *host, uint64_t wanted, const ff_march *m);
void ff_results_destroy(ff_results *r);

/* Takes down the march's newest film; `last`: none will follow. */
ff_status ff_results_record(ff_results *r, ff_march *m, int last);

/* Estimates of the errors of the row being filled in: h_min is at `node`. */
void ff_results_errors(ff_results *r, const ff_march *m, size_t node, double h_central,
                       double p_max);

/* All outputs and the quality record. */
ff_status ff_results_finish(const ff_results *r, const ff_march *m);

void ff_results_quality(const ff_results *r, const ff_march *m);

#endif
