/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is kept of the film at each time, and how far it can be trusted. */
#ifndef FF_EHL_RESULTS_H
#define FF_EHL_RESULTS_H

#include "march.h"
#include "model.h"

typedef struct ff_results {
    const ff_host *host;
    uint64_t wanted;
    size_t count, nodes;
    double *series[FF_EHL_SERIES]; /* NULL: not wanted */
    double *film, *pressure;
    double *tau, *ln_eta, *memory;
    double lowest, lowest_at, highest;
    double worst_load, worst_mass, worst_complement, least_resolution, least_inlet, lost_force;
    double time_error; /* of h_min, m */
    int out_of_law;
} ff_results;

ff_status ff_results_create(ff_results *r, const ff_host *host, uint64_t wanted, size_t count,
                            const ff_march *m);
void ff_results_destroy(ff_results *r);

/* Takes down the march's newest film as number `k`. */
void ff_results_record(ff_results *r, ff_march *m, size_t k);

/* Scalars, x, and the quality record. */
ff_status ff_results_finish(ff_results *r, const ff_march *m);

#endif
