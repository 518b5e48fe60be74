/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Feeds a dynamic model with a gear pair: a duty, a mesh cycle and a few stations. */
#ifndef TEST_DYNAMICS_PAIR_H
#define TEST_DYNAMICS_PAIR_H

#include "stage.h"

#include <stdbool.h>

enum { PAIR_MAX_PHASES = 4096, PAIR_STATIONS = 11 };

typedef struct pair {
    double mesh_frequency, line_force, backlash, mass, stiffness_mean;
    size_t phases;
    double phase[PAIR_MAX_PHASES], stiffness[PAIR_MAX_PHASES], error[PAIR_MAX_PHASES];
    double roll[PAIR_STATIONS], tooth_force[PAIR_STATIONS], load_share[PAIR_STATIONS];
} pair;

/* Li & Kahraman 2011: 50/50 teeth, 3242 Hz, b = 70 um, F = 0.1408 b k; k(t) a trapezoid of two
   levels whose ratio is 0.65, two pairs for 0.755 of the cycle, ramps of 0.04, and phase 0 in the
   middle of the two-pair zone. Damping and natural frequency as the models have them by default. */
pair pair_trapezoid(double mesh_frequency);

/* The same with other excitations: k(1 + sum a_i cos(2 pi i phase)), or e like that, by `points`
   straight lines. */
pair pair_cosine(double mesh_frequency, double stiffness_1, double error_1, size_t points);

/* Opens a model that is fed with the pair, which must outlive it. */
stage *pair_open(const char *id, const pair *p);

/* Whether all lines of the motion are good, in a run of its own: its stations are too few for the
   tooth force. */
bool pair_is_trusted(stage *s);

/* Mean of the straight lines, after a change of the stiffness. */
double pair_mean(const pair *p);

extern const double pair_natural_frequency; /* Hz, of mass and mean stiffness */

#endif
