/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Deviations of the flanks from true involutes: reliefs, profile crown, profile slope, a measured
 * curve, and index deviations tooth by tooth. Deviations are positive where there is more metal, in
 * the direction of the normal (ISO 1328-1); reliefs and crown take metal off.
 */
#ifndef GEAR_FLANK_DEVIATIONS_H
#define GEAR_FLANK_DEVIATIONS_H

#include "spur-geometry.h"

#include <flankfilm/plugin.h>

/* A relief from `start` to the end of the flank; start below 0: the default. */
typedef struct gear_relief {
    double amount[2], start[2]; /* m, roll angle of the own gear */
    bool start_given, parabolic;
} gear_relief;

/* A measured curve, linear between its points. */
typedef struct gear_curve {
    size_t count;
    double *roll, *deviation;
} gear_curve;

typedef struct gear_flank_spec {
    gear_relief tip, root;
    double crown[2];  /* taken off both ends of the flank */
    double slope[2];  /* f_H_alpha: rise from the lowest contact to the tip */
    double *index[2]; /* first teeth; the others have none */
    size_t indexed[2];
    char *file;
} gear_flank_spec;

/* The flanks that come from a specification. */
typedef struct gear_flanks {
    double low[2], high[2]; /* roll angles of the lowest contact and of the tip, own gear */
    double tip_start[2], root_start[2];
    gear_curve measured[2];
    size_t knots;
    double *roll[2], *deviation[2]; /* of the profiles, linear between knots */
} gear_flanks;

/* Checks the specification against the pair and samples the profiles. Free in any case. */
ff_status gear_flanks_make(const ff_host *host, const gear_flank_spec *spec,
                           const gear_spur_spec *gears, const gear_spur_pair *pair,
                           gear_flanks *flanks);
void gear_flanks_free(gear_flanks *flanks);

enum { GEAR_CURVE_GEAR, GEAR_CURVE_ROLL, GEAR_CURVE_DEVIATION, GEAR_CURVE_COLUMNS };
extern const ff_param gear_curve_columns[GEAR_CURVE_COLUMNS];

/* measured-curves.c: reads a file with the columns gear, roll_angle and deviation. Free in any
 * case. */
ff_status gear_curves_read(const ff_host *host, const char *item, const char *path,
                           gear_curve curve[2]);

#endif
