/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the trace of a flank to its roughness; records of n evenly spaced heights. */
#ifndef SURFACE_ROUGHNESS_H
#define SURFACE_ROUGHNESS_H

#include <flankfilm/plugin.h>

/* Takes off the polynomial of this order that fits best; order < n. */
ff_status surface_detrend(size_t n, int order, double *height);

/* Takes off (long waves) or keeps (short waves) what the Gaussian filter of ISO 16610-21 passes;
   cutoff over the spacing of the points, at most n. The record is mirrored at its ends, so that
   the filter keeps the mean. */
ff_status surface_take_off_longer(size_t n, double cutoff, double *height);
ff_status surface_take_off_shorter(size_t n, double cutoff, double *height);

#endif
