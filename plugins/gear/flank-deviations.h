/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Deviations of the flanks from true involutes: reliefs, profile crown, profile slope, a measured
 * curve, and index deviations tooth by tooth. Deviations are positive where there is more metal, in
 * the direction of the normal (ISO 1328-1); reliefs and crown take metal off.
 */
#ifndef FF_FLANK_DEVIATIONS_H
#define FF_FLANK_DEVIATIONS_H

#include "spur-geometry.h"

#include <flankfilm/plugin.h>

/* A relief from `start` to the end of the flank; start below 0: the default. */
typedef struct ff_relief {
    double amount[2], start[2]; /* m, roll angle of the own gear */
    bool start_given, parabolic;
} ff_relief;

/* A measured curve, linear between its points. */
typedef struct ff_curve {
    size_t count;
    double *roll, *deviation;
} ff_curve;

typedef struct ff_flank_spec {
    ff_relief tip, root;
    double crown[2];  /* taken off both ends of the flank */
    double slope[2];  /* f_H_alpha: rise from the lowest contact to the tip */
    double *index[2]; /* first teeth; the others have none */
    size_t indexed[2];
    char *file;
} ff_flank_spec;

/* The flanks that come from a specification. */
typedef struct ff_flanks {
    double low[2], high[2]; /* roll angles of the lowest contact and of the tip, own gear */
    double tip_start[2], root_start[2];
    ff_curve measured[2];
    size_t knots;
    double *roll[2], *deviation[2]; /* of the profiles, linear between knots */
} ff_flanks;

/* Checks the specification against the pair and samples the profiles. Free in any case. */
ff_status ff_flanks_make(const ff_host *host, const ff_flank_spec *spec, const ff_spur_spec *gears,
                         const ff_spur_pair *pair, ff_flanks *flanks);
void ff_flanks_free(ff_flanks *flanks);

enum { FF_CURVE_GEAR, FF_CURVE_ROLL, FF_CURVE_DEVIATION, FF_CURVE_COLUMNS };
extern const ff_param ff_curve_columns[FF_CURVE_COLUMNS];

/* measured-curves.c: reads a file with the columns gear, roll_angle and deviation. Free in any
 * case. */
ff_status ff_curves_read(const ff_host *host, const char *item, const char *path,
                         ff_curve curve[2]);

#endif
