/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the film at each time as outputs, and records how far it can be trusted. */
#ifndef EHL_OUTPUTS_H
#define EHL_OUTPUTS_H

#include "balance.h"
#include "history.h"
#include "stage.h"
#include "time-stepper.h"

/* A table of rows of equal width, which grows: their number is known at the end only. */
typedef struct ehl_rows {
    double *data;
    size_t width, count, room;
} ehl_rows;

typedef struct ehl_results {
    const ff_host *host;
    ehl_balance balance;
    uint64_t wanted;
    size_t nodes;
    double boundary_friction;
    double roughness;                   /* m, combined rms of both flanks; 0: unknown */
    ehl_rows series, field[EHL_FIELDS]; /* width 0: not wanted */
    double *row;                        /* row of the series that is being filled in */
    double *tau, *ln_eta, *memory;
    double lowest, lowest_at, highest, least_lambda;
    ehl_lowest engagements;
    double worst_load, worst_mass, worst_complement, lost_force;
    double least_resolution, least_inlet, worst_starvation;
    double outlet_load, worst_outlet;     /* share of the load: mean over a passage, its largest */
    double worst_in_time, worst_in_space; /* errors of h_min, relative */
    double worst_central_in_time, worst_central_in_space;   /* and of h_central */
    double worst_peak;                                      /* error of p_max by the cells */
    double worst_gap_excess, widest_gap;                    /* while the contact is lost, m */
    double share_sum, ratio_sum, trapped_sum, worst_supply; /* sums over rough, loaded instants */
    double yield_sum, deepest_yield, worst_yield; /* the same; deepest_yield: plastic part, m */
    size_t loaded;
    double tail_share; /* share of the pressure flow's loss that lies upstream of the domain */
    size_t starved;    /* instants without such a loss: the domain begins cavitated */
    double undecided;  /* the solver's counter when the mass was recorded last */
    ehl_law_answer laws;
    int rough;
} ehl_results;

ff_status ehl_results_create(ehl_results *r, const ff_host *host, uint64_t wanted,
                             const ehl_march *m);
void ehl_results_destroy(ehl_results *r);

/* Records the newest film of the march; `last`: no other will follow. */
ff_status ehl_results_record(ehl_results *r, ehl_march *m, int last);

/* Estimates the errors of the row that is being filled in; h_min is at `node`. */
void ehl_results_errors(ehl_results *r, const ehl_march *m, size_t node, double h_central,
                        double p_max);

/* Writes all outputs and the quality record. */
ff_status ehl_results_finish(const ehl_results *r, const ehl_march *m);

void ehl_results_quality(const ehl_results *r, const ehl_march *m);

/* 1: an output is wanted that takes the shear stress, or one that takes the pressure flow. */
int ehl_loss_of_shear(uint64_t wanted);
int ehl_loss_of_flow(uint64_t wanted);

#endif
