/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tolerances for the rounding of drawings. A drawing gives lengths and coefficients with a few
   digits, so gears typed from it may overlap or exceed a limit by a rounding error. Every
   comparison of given dimensions uses a tolerance of this file. A dimension that exceeds a limit by
   less than its tolerance is moved to the limit, so that later calculations are consistent. */
#ifndef GEAR_DRAWING_ROUNDING_H
#define GEAR_DRAWING_ROUNDING_H

#include "spur-geometry.h"

/* Tolerance of roll angles, which have two digits on drawings; rad. */
extern const double gear_rounding_roll;
/* Tolerance of diameters, which have two digits on drawings; m. */
extern const double gear_rounding_diameter;

/* Returns the uncertainty of the backlash along the line of action, at the working pressure angle,
   from the digits of the centre distance, the profile shifts, and the backlash or the measured
   tooth thickness. */
double gear_rounding_of_backlash(const gear_spur_spec *spec, const gear_spur_pair *pair);
/* Returns the uncertainty of the gap between tip and root from the digits of diameters and centre
   distance. */
double gear_rounding_of_clearance(const gear_spur_spec *spec);

/* Writes into `text` which dimensions were moved because of rounding; "" if none was moved.
   `moved_start`: largest move of a relief's start, rad. */
void gear_rounding_say(const gear_spur_pair *pair, double moved_start, char *text, size_t size);

#endif
