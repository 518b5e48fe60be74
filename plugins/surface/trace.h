/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A profilometer trace from a file with the columns position and height. */
#ifndef FF_SURFACE_TRACE_H
#define FF_SURFACE_TRACE_H

#include <flankfilm/plugin.h>

/* n >= 2 points at increasing positions, SI. */
typedef struct ff_trace {
    size_t n;
    const double *position, *height; /* the host's */
} ff_trace;

enum { FF_TRACE_POSITION, FF_TRACE_HEIGHT, FF_TRACE_COLUMNS };
extern const ff_param ff_trace_columns[FF_TRACE_COLUMNS];

/* Lives as long as the instance. */
ff_status ff_trace_read(const ff_host *host, const char *item, const char *path, ff_trace *trace);

/* The heights at position[0] + i * spacing: means of the straight lines between the points over
   the cells around them, so that resampling keeps the integral; points that already stand there
   are taken as they are. height holds ff_trace_cells(). */
size_t ff_trace_cells(const ff_trace *trace, double spacing);
void ff_trace_resample(const ff_trace *trace, double spacing, size_t n, double *height);

/* Root mean square distance of the points of the file from n resampled heights. */
double ff_trace_departure(const ff_trace *trace, double spacing, size_t n, const double *height);

#endif
