/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The heights of rough flanks once more, by sums of their own, for the balances (balance.h). */
#ifndef EHL_TRACES_H
#define EHL_TRACES_H

#include "surface.h"

/* R1 + R2, the mean over a cell of that width whose middle is x along the entrainment. */
double ehl_traces_height(const ehl_roughness *r, double x, double width, double time);

#endif
