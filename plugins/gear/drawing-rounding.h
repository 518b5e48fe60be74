/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tolerances from the rounding of drawings. A drawing gives lengths and coefficients with a few
 * digits, so gears typed from it may overlap or exceed a limit by a rounding error. Every check
 * of stated dimensions against each other takes its tolerance from here, and moves a dimension
 * to the limit so that later calculations fit exactly. */
#ifndef GEAR_DRAWING_ROUNDING_H
#define GEAR_DRAWING_ROUNDING_H

#include "spur-geometry.h"

/* Roll angles on drawings have two digits; in rad. */
extern const double gear_rounding_roll;
/* Diameters on drawings have two digits; in m. */
extern const double gear_rounding_diameter;

/* Returns how much the backlash along the line of action may be off at the working pressure
 * angle, by the digits of the centre distance, the profile shifts, and the backlash or the
 * measured tooth thickness. */
double gear_rounding_of_backlash(const gear_spur_spec *spec, const gear_spur_pair *pair);
/* Returns how much the gap between tip and root may be off by the digits of diameters and centre
 * distance. */
double gear_rounding_of_clearance(const gear_spur_spec *spec);

/* Writes into `text` which dimensions were moved because of rounding, with the largest move of a
 * relief's start in rad; "" if none was. */
void gear_rounding_say(const gear_spur_pair *pair, double moved_start, char *text, size_t size);

#endif
