/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The films of all tooth pairs in the previous round of the feedback loop, at any phase of the mesh
 * cycle. Each is the mean over the engagements of the film history.
 */
#ifndef DYNAMICS_FILM_HISTORY_H
#define DYNAMICS_FILM_HISTORY_H

#include "inputs.h"

/* Largest number of pairs in mesh: twice the limit of gear/involute-spur. */
enum { DYNAMICS_FILM_PAIRS = 8 };

/* One film history: several consecutive engagements. */
typedef struct dynamics_film_history {
    size_t count, engagements, *first; /* first: index of the first step of each engagement;
                                          first[engagements] = count */
    const double *roll, *engagement, *traction, *rolling, *loss;
    const double *load; /* load per width, N/m; NULL: load shares are those of the mean force */
    double *thickness;
    double speed[2]; /* speeds of the gears, rad/s */
    double width;
    int in_oil; /* input: whether the motion includes the film between separated flanks */
    const ff_array *in;
    const dynamics_inputs *inputs;
} dynamics_film_history;

/* Sums over all pairs in mesh: torques against the rotation of each gear, film thickness in series
   with the mesh, power loss, and force. `film` and `share` are the thickness and the load share of
   each pair. */
typedef struct dynamics_film_sum {
    double against[2], thickness, loss, force;
    double film[DYNAMICS_FILM_PAIRS], share[DYNAMICS_FILM_PAIRS];
} dynamics_film_sum;

/* Reads and checks the film history. Free it also after a failure. */
ff_status dynamics_film_history_read(const ff_host *host, const ff_array *in,
                                     const dynamics_inputs *inputs, dynamics_film_history *y);

void dynamics_film_history_free(dynamics_film_history *y);

/* Returns the sums at a phase. At the ends of an engagement the limit from the left is used if
   `before` is set, else the limit from the right. */
dynamics_film_sum dynamics_film_history_at(const dynamics_film_history *y, double phase,
                                           int before);

#endif
