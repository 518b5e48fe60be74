/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What every surface model gives: the heights of both flanks over one arc coordinate s, which runs
 * along x. At the time t the point s of flank i stands at x = s - origin + integral of u_i from
 * the first time to t.
 */
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

enum { SURFACE_POINTS = 1 << 18 }; /* the longest record */

extern const ff_port surface_outputs[SURFACE_OUTPUTS];

/* Heights at i * spacing, positive out of the metal. */
typedef struct surface_record {
    size_t n;
    double spacing, origin;
    bool repeats;
    double *height[2];
    double rq[2];
} surface_record;

/* n points at height 0; FF_INVALID names `item` when they are too many. Free in any case. */
ff_status surface_record_make(const ff_host *host, const char *item, double n, double spacing,
                              surface_record *record);
void surface_record_free(surface_record *record);

/* Root mean square about the mean. */
double surface_rms(size_t n, const double *height);

ff_status surface_record_give(const ff_host *host, uint64_t wanted, const surface_record *record);

#endif
