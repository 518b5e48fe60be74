/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The truncation errors of the time steps, and their sum along the path of the film through the
   contact. */
#ifndef EHL_TRUNCATION_H
#define EHL_TRUNCATION_H

#include "../equations/march.h"

/* Returns the largest |local| over all nodes. */
double ehl_march_truncation(const ehl_march *m);

/* Estimates the truncation error of the step to the trial, in `local`. */
void ehl_estimate_truncation(ehl_march *m);

/* Moves the accumulated truncation error with the film by `distance`, and adds that of the
   trial. */
void ehl_advect_error(ehl_march *m, double distance);

#endif
