/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The truncation errors of the time steps, and their sum along the path of the film through the
   contact. */
#ifndef EHL_TRUNCATION_H
#define EHL_TRUNCATION_H

#include "../equations/march.h"

/* Returns the largest |local| over all nodes. */
double ehl_march_truncation(const ehl_march *m);

/* Returns the node where the outlet begins, 1.6 build-up lengths inside x = a, as a fraction. */
double ehl_outlet_begins(const ehl_reynolds *eq, double a, double buildup);

/* Returns the sum of truncation errors as large as those of the trial along the path of the oil,
   times the length of the step: over `time` in the contact, over at most the time in which the oil
   crosses the outlet there, s. */
double ehl_truncation_sum(const ehl_march *m, double time);

/* Estimates the truncation error of the step to the trial, in `local`. */
void ehl_estimate_truncation(ehl_march *m);

/* Moves the accumulated truncation error with the film by `distance`, and adds that of the
   trial. */
void ehl_advect_error(ehl_march *m, double distance);

#endif
