/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Error estimates of the models of mesh stiffness. They are relative to load-distribution, the most
 * exact model of the kind: the largest difference, rounded up, on random pairs (18 to 45 teeth on
 * the pinion, ratios from 1 to 3, modules from 1.5 to 6 mm, 30 to 700 N/mm), as
 * tests/plugins/stiffness/choose.py draws them.
 */
#ifndef STIFFNESS_ASSESS_H
#define STIFFNESS_ASSESS_H

#include <flankfilm/plugin.h>

/* Errors of tooth_force and load_share on the mean over the path, of the stiffness on the mean over
   the cycle, and of the alternating part of the transmission errors. */
typedef struct stiffness_error_estimate {
    double force, stiffness, transmission;
    double cost; /* s */
    const char *reason;
} stiffness_error_estimate;

/* The largest of the errors that concern the wanted outputs; deviations of the flanks double it. */
ff_status stiffness_assess(const stiffness_error_estimate *estimate, uint64_t wanted,
                           const ff_array *in, ff_assessment *assessment);

#endif
