/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A spur pair computed here from its basic data, so that models are fed without a gear stage. */
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
    double roll[PAIR_STATIONS]; /* mirrored about the middle; LPSTC and HPSTC twice */
    size_t lpstc, hpstc;        /* their first stations */
} spur_pair;

/* 20 deg teeth of steel with that addendum (in modules), profile shifts, and no play. */
spur_pair spur_pair_make(double z1, double z2, double module, double addendum, double x1,
                         double x2);
/* The same gears with the driven one driving. */
spur_pair spur_pair_swap(const spur_pair *pair);

/* What every source of stiffness takes; the pair must outlive the run. */
void feed_path(stage *s, const spur_pair *pair);
/* What the potential-energy model takes besides. */
void feed_teeth(stage *s, const spur_pair *pair);

#endif
