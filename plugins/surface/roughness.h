/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Removes form and waviness from n evenly spaced heights. */
#ifndef SURFACE_ROUGHNESS_H
#define SURFACE_ROUGHNESS_H

#include <flankfilm/plugin.h>

/* Subtracts the best polynomial of this order; order < n. */
ff_status surface_detrend(size_t n, int order, double *height);

/* The continuation of a record beyond its ends: its mirror image, or its repetition. */
typedef enum surface_end { SURFACE_MIRRORED, SURFACE_REPEATED } surface_end;

/* Remove waves longer than the cut-off, by subtracting the result of the Gaussian filter of ISO
 * 16610-21, or shorter waves, by keeping only its result. `cutoff` is in spacings of the points;
 * for a mirrored record it must be at most n. The filter preserves the mean. */
ff_status surface_remove_longer(size_t n, double cutoff, double *height);
ff_status surface_remove_shorter(size_t n, double cutoff, surface_end end, double *height);

#endif
