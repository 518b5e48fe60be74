/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measured profiles from a file; each row is a point of a gear's curve. */
#ifndef GEAR_MEASURED_CURVES_H
#define GEAR_MEASURED_CURVES_H

#include <flankfilm/plugin.h>

/* Deviation in m over the roll angle of the gear itself in rad, linear between the points. */
typedef struct gear_curve {
    size_t count;
    double *roll, *deviation;
} gear_curve;

enum { GEAR_CURVE_GEAR, GEAR_CURVE_ROLL, GEAR_CURVE_DEVIATION, GEAR_CURVE_COLUMNS };
extern const ff_param gear_curve_columns[GEAR_CURVE_COLUMNS];

/* Reads the columns gear, roll_angle and deviation. The caller frees the curves, also after an
   error. */
ff_status gear_curves_read(const ff_host *host, const char *item, const char *path,
                           gear_curve curve[2]);

#endif
