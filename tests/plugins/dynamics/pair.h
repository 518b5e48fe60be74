/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inputs of a dynamic model: gear pair, operating point, mesh cycle and some stations. */
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

/* Makes the pair of Li & Kahraman 2011: 50/50 teeth, 3242 Hz, b = 70 um, F = 0.1408 b k; k(t) is a
   trapezoid with two levels of ratio 0.65, double contact for 0.755 of the cycle, ramps of 0.04,
   and phase 0 in the middle of double contact. Default damping and natural frequency. */
pair pair_trapezoid(double mesh_frequency);

/* Makes this pair with the stiffness k(1 + sum a_i cos(2 pi i phase)), or e of this form, as
   `points` straight lines. */
pair pair_cosine(double mesh_frequency, double stiffness_1, double error_1, size_t points);

/* Opens a model with the inputs of a pair, which must exist until the model is closed. */
stage *pair_open(const char *id, const pair *p);

/* Runs the model again without tooth forces, for which the stations are too few, and returns
   whether all quality lines are good. */
bool pair_is_trusted(stage *s);

/* Returns the mean stiffness of the straight lines, after a change of the stiffness. */
double pair_mean(const pair *p);

extern const double pair_natural_frequency; /* Hz, from mass and mean stiffness */

#endif
