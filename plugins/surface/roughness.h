/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Form and waviness are removed from n evenly spaced heights. */
#ifndef SURFACE_ROUGHNESS_H
#define SURFACE_ROUGHNESS_H

#include <flankfilm/plugin.h>

/* Subtracts the polynomial of this order that fits best; order < n. */
ff_status surface_detrend(size_t n, int order, double *height);

/* What follows a record at either end: its mirror image, or the record once more. */
typedef enum surface_end { SURFACE_MIRRORED, SURFACE_REPEATED } surface_end;

/* Removes waves longer than the cut-off by subtracting what the Gaussian filter of ISO 16610-21
   passes, or shorter waves by keeping that alone. `cutoff` is in spacings of the points, at most n
   where the record is mirrored. The filter keeps the mean. */
ff_status surface_remove_longer(size_t n, double cutoff, double *height);
ff_status surface_remove_shorter(size_t n, double cutoff, surface_end end, double *height);

#endif
