/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads and resamples profilometer traces. */
#include "trace.h"

#include "record.h"

#include <flankfilm/table.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* The limits of 1 m refuse traces that are too long or high for a flank. */
const ff_param surface_trace_columns[SURFACE_TRACE_COLUMNS] = {
    {.name = "position",
     .unit = "um",
     .doc = "position along the profile",
     .type = FF_REALS,
     .flags = FF_REQUIRED,
     .min = -1e6,
     .max = 1e6,
     .min_count = 2,
     .max_count = SURFACE_POINTS},
    {.name = "height",
     .unit = "um",
     .doc = "height of the profile, positive out of the metal",
     .type = FF_REALS,
     .flags = FF_REQUIRED,
     .min = -1e6,
     .max = 1e6},
};

ff_status surface_trace_read(const ff_host *host, const char *item, const char *path,
                             surface_trace *trace)
{
    const ff_table *t;
    *trace = (surface_trace){0};
    ff_status status = ff_table_read(host, item, path, FF_TABLE(surface_trace_columns), &t);
    if (status != FF_OK)
        return status;
    const double *position = t->columns[SURFACE_TRACE_POSITION];
    for (size_t i = 1; i < t->row_count; i++)
        if (!(position[i] > position[i - 1]))
            return ff_table_failf(host, t, i, SURFACE_TRACE_POSITION,
                                  "the positions must increase from line to line");
    *trace = (surface_trace){t->row_count, position, t->columns[SURFACE_TRACE_HEIGHT]};
    return FF_OK;
}

size_t surface_trace_cells(const surface_trace *t, double spacing)
{
    double cells = floor((t->position[t->n - 1] - t->position[0]) / spacing * (1 + 1e-9)) + 1;
    return cells <= SURFACE_POINTS ? (size_t)cells : SURFACE_POINTS + 1;
}

/* Returns whether the points of the file already lie at the required positions. */
static bool stands_at(const surface_trace *t, double spacing, size_t n)
{
    bool stands = t->n == n;
    for (size_t i = 0; i < n && stands; i++)
        stands = fabs(t->position[i] - t->position[0] - spacing * (double)i) < 1e-6 * spacing;
    return stands;
}

/* Returns the integral of the trace from its first point to x. Repeated calls must have increasing
   x: *k is the interval that contains x, *before the integral up to its start. */
static double integral_to(const surface_trace *t, double x, size_t *k, double *before)
{
    const double *p = t->position, *z = t->height;
    while (*k + 2 < t->n && p[*k + 1] < x) {
        *before += (p[*k + 1] - p[*k]) * (z[*k] + z[*k + 1]) / 2;
        ++*k;
    }
    double part = x - p[*k], slope = (z[*k + 1] - z[*k]) / (p[*k + 1] - p[*k]);
    return *before + part * (z[*k] + slope * part / 2);
}

void surface_trace_resample(const surface_trace *t, double spacing, size_t n, double *height)
{
    const double first = t->position[0], last = t->position[t->n - 1];
    if (stands_at(t, spacing, n)) {
        memcpy(height, t->height, n * sizeof *height);
        return;
    }
    size_t k = 0;
    double before = 0, from = first, sum = 0;
    for (size_t i = 0; i < n; i++) {
        double to = fmin(first + spacing * ((double)i + 0.5), last);
        double next = integral_to(t, to, &k, &before);
        height[i] = (next - sum) / (to - from);
        from = to;
        sum = next;
    }
}

double surface_trace_distance(const surface_trace *t, double spacing, size_t n,
                              const double *height)
{
    double sum = 0;
    for (size_t i = 0; i < t->n; i++) {
        double at = fmin((t->position[i] - t->position[0]) / spacing, (double)(n - 1));
        size_t k = (size_t)fmin(floor(at), (double)n - 2);
        double part = at - (double)k;
        double off = height[k] + part * (height[k + 1] - height[k]) - t->height[i];
        sum += off * off;
    }
    return sqrt(sum / (double)t->n);
}
