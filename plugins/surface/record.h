/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outputs of every surface model: the heights of both flanks over one arc coordinate s along x. At
   time t, point s of flank i is at x = s - origin + the integral of its speed u_i from the first
   time to t. */
#ifndef SURFACE_RECORD_H
#define SURFACE_RECORD_H

#include <flankfilm/plugin.h>

#include <stdbool.h>

enum {
    SURFACE_POSITION,
    SURFACE_HEIGHT_1,
    SURFACE_HEIGHT_2,
    SURFACE_RQ_1,
    SURFACE_RQ_2,
    SURFACE_PERIOD,
    SURFACE_ORIGIN,
    SURFACE_OUTPUTS
};

enum { SURFACE_POINTS = 1 << 18 }; /* largest number of points of a record */

extern const ff_port surface_outputs[SURFACE_OUTPUTS];

/* Heights at s = i * spacing, positive out of the metal; in m. */
typedef struct surface_record {
    size_t n;
    double spacing, origin;
    bool repeats;
    double *height[2];
    double rq[2];
} surface_record;

/* Creates a record of n points with height 0. Too many points give FF_INVALID with `item`. The
   caller frees the record, also after an error. */
ff_status surface_record_make(const ff_host *host, const char *item, double n, double spacing,
                              surface_record *record);
void surface_record_free(surface_record *record);

/* Returns whether the parameter `flank` (1, 2, or -1 for `both`) includes flank g, which is 0 or
   1. */
static inline bool surface_has_flank(int64_t flank, int g)
{
    return flank < 0 || flank == g + 1;
}

/* Returns the root mean square about the mean. */
double surface_rms(size_t n, const double *height);

/* Writes the wanted outputs. */
ff_status surface_record_publish(const ff_host *host, uint64_t wanted,
                                 const surface_record *record);

#endif
