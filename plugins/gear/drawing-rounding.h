/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the rounding of a drawing allows. A drawing gives lengths and coefficients with so many
 * digits, and gears typed from it may overlap or end beyond a limit by what those digits leave
 * open. Every check of stated dimensions against each other takes its tolerance from here and moves
 * a dimension on to the limit, so that what is computed later fits exactly.
 */
#ifndef GEAR_DRAWING_ROUNDING_H
#define GEAR_DRAWING_ROUNDING_H

#include "spur-geometry.h"

/* Roll angles on drawings have two digits, rad. */
extern const double gear_rounding_roll;
/* Diameters on drawings have two digits, m. */
extern const double gear_rounding_diameter;

/* The backlash along the line of action that the digits of centre distance and profile shifts, and
   of the backlash or of what was measured on the teeth, leave open at the working angle of the
   pair. */
double gear_rounding_of_backlash(const gear_spur_spec *spec, const gear_spur_pair *pair);
/* The gap between tip and root that the digits of diameters and centre distance leave open. */
double gear_rounding_of_clearance(const gear_spur_spec *spec);

/* Writes what was moved for the rounding into `text`, with the largest move of a relief's start in
   rad; "" when nothing was. */
void gear_rounding_say(const gear_spur_pair *pair, double moved_start, char *text, size_t size);

#endif
