/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the films of the tooth pairs were in the round before, at any phase of the mesh cycle: the
 * mean over the engagements of their history.
 */
#ifndef DYNAMICS_FILM_HISTORY_H
#define DYNAMICS_FILM_HISTORY_H

#include "inputs.h"

/* The most pairs in mesh: twice what gear/involute-spur allows. */
enum { DYNAMICS_FILM_PAIRS = 8 };

/* One film history: several engagements behind each other. */
typedef struct dynamics_film_history {
    size_t count, engagements, *first; /* first: of each engagement, and the count behind them */
    const double *roll, *engagement, *traction, *rolling, *loss;
    const double *load; /* per width; NULL: the shares are those of the mean force */
    double *thickness;
    double speed[2]; /* of the gears, rad/s */
    double width;
    int in_oil; /* given: the motion knows the film between parted flanks */
    const ff_array *in;
    const dynamics_inputs *inputs;
} dynamics_film_history;

/* Torques of all pairs against the rotation of each gear, the film in series with the mesh, what
   the films dissipate, the force that they bear, and of each pair its film and its share of it. */
typedef struct dynamics_film_sum {
    double against[2], thickness, loss, force;
    double film[DYNAMICS_FILM_PAIRS], share[DYNAMICS_FILM_PAIRS];
} dynamics_film_sum;

/* Reads and checks; to be freed, also after a failure. */
ff_status dynamics_film_history_read(const ff_host *host, const ff_array *in,
                                     const dynamics_inputs *inputs, dynamics_film_history *y);

void dynamics_film_history_free(dynamics_film_history *y);

/* At the ends of an engagement `before` the phase or behind it. */
dynamics_film_sum dynamics_film_history_at(const dynamics_film_history *y, double phase,
                                           int before);

#endif
