/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A spur gear pair computed from its basic data, as input for models without a gear stage. */
#ifndef TEST_STIFFNESS_PAIR_H
#define TEST_STIFFNESS_PAIR_H

#include "stage.h"

enum { PAIR_STATIONS = 45 };

typedef struct spur_pair {
    double teeth[2], module, width;
    double base[2], reference[2], tip[2], root[2], bore[2], thickness[2];
    double modulus[2], poisson[2];
    double working_angle, roll_sap, roll_tip, pitch, contact_ratio;
    double line_force;
    double roll[PAIR_STATIONS]; /* symmetric about the middle; LPSTC and HPSTC have two stations
                                   each */
    size_t lpstc, hpstc;        /* their first stations */
} spur_pair;

/* Makes a pair of 20 deg steel teeth with an addendum, in modules, and profile shifts, without
   backlash. */
spur_pair spur_pair_make(double z1, double z2, double module, double addendum, double x1,
                         double x2);
/* Returns the same gears in exchanged order. */
spur_pair spur_pair_swap(const spur_pair *pair);

/* Gives the inputs of all stiffness models; the pair must exist until the run has ended. */
void feed_path(stage *s, const spur_pair *pair);
/* Gives the further inputs of stiffness/potential-energy. */
void feed_teeth(stage *s, const spur_pair *pair);

#endif
