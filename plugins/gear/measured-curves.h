/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measured profiles from a file; each row is a point of a gear's curve. */
#ifndef GEAR_MEASURED_CURVES_H
#define GEAR_MEASURED_CURVES_H

#include <flankfilm/plugin.h>

/* Deviation in m over the gear's own roll angle in rad, linear between the points. */
typedef struct gear_curve {
    size_t count;
    double *roll, *deviation;
} gear_curve;

enum { GEAR_CURVE_GEAR, GEAR_CURVE_ROLL, GEAR_CURVE_DEVIATION, GEAR_CURVE_COLUMNS };
extern const ff_param gear_curve_columns[GEAR_CURVE_COLUMNS];

/* Reads the columns gear, roll_angle and deviation. To be freed in any case. */
ff_status gear_curves_read(const ff_host *host, const char *item, const char *path,
                           gear_curve curve[2]);

#endif
