/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A second, independent computation of the heights of rough flanks, for the balances
   (balance.h). */
#ifndef EHL_ROUGHNESS_CHECK_H
#define EHL_ROUGHNESS_CHECK_H

#include "surface.h"

/* Returns the mean of R1 + R2 over a cell of that width. Its centre is at x along the
   entrainment. */
double ehl_traces_height(const ehl_roughness *r, double x, double width, double time);

#endif
