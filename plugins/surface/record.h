/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What every surface model gives: the heights of both flanks over one arc coordinate s, which runs
 * along x. At the time t the point s of flank i stands at x = s - origin + integral of u_i from
 * the first time to t.
 */
#ifndef FF_SURFACE_RECORD_H
#define FF_SURFACE_RECORD_H

#include <flankfilm/plugin.h>

#include <stdbool.h>

enum {
    FF_SURFACE_POSITION,
    FF_SURFACE_HEIGHT_1,
    FF_SURFACE_HEIGHT_2,
    FF_SURFACE_RQ_1,
    FF_SURFACE_RQ_2,
    FF_SURFACE_PERIOD,
    FF_SURFACE_ORIGIN,
    FF_SURFACE_OUTPUTS
};

enum { FF_SURFACE_POINTS = 1 << 18 }; /* the longest record */

extern const ff_port ff_surface_outputs[FF_SURFACE_OUTPUTS];

/* Heights at i * spacing, positive out of the metal. */
typedef struct ff_record {
    size_t n;
    double spacing, origin;
    bool repeats;
    double *height[2];
    double rq[2];
} ff_record;

/* n points at height 0; FF_INVALID names `item` when they are too many. Free in any case. */
ff_status ff_record_make(const ff_host *host, const char *item, double n, double spacing,
                         ff_record *record);
void ff_record_free(ff_record *record);

/* Root mean square about the mean. */
double ff_surface_rms(size_t n, const double *height);

ff_status ff_record_give(const ff_host *host, uint64_t wanted, const ff_record *record);

#endif
