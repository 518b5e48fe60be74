/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A profilometer trace from a file with the columns position and height. */
#ifndef SURFACE_TRACE_H
#define SURFACE_TRACE_H

#include <flankfilm/plugin.h>

/* n >= 2 points at increasing positions, SI. */
typedef struct surface_trace {
    size_t n;
    const double *position, *height; /* owned by the host */
} surface_trace;

enum { SURFACE_TRACE_POSITION, SURFACE_TRACE_HEIGHT, SURFACE_TRACE_COLUMNS };
extern const ff_param surface_trace_columns[SURFACE_TRACE_COLUMNS];

/* Reads and checks the file; the trace is valid as long as the instance. */
ff_status surface_trace_read(const ff_host *host, const char *item, const char *path,
                             surface_trace *trace);

/* Computes the heights at position[0] + i * spacing. Each is the mean of the piecewise linear trace
   over the cell around it, so that resampling preserves the integral. Points that already have this
   spacing are copied. `height` must have room for surface_trace_cells() numbers. */
size_t surface_trace_cells(const surface_trace *trace, double spacing);
void surface_trace_resample(const surface_trace *trace, double spacing, size_t n, double *height);

/* Returns the root mean square distance between the points of the file and the n resampled
 * heights, m. */
double surface_trace_distance(const surface_trace *trace, double spacing, size_t n,
                              const double *height);

#endif
