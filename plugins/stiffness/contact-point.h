/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds where a pair of teeth touches: on the path of contact, or at a tip corner before SAP or
   after the tip. */
#ifndef STIFFNESS_CONTACT_POINT_H
#define STIFFNESS_CONTACT_POINT_H

#include "gears.h"

#include <stdbool.h>

/* Returns the roll angle of gear 0 or 1 at which a pair of that age is in contact on the line of
   action. The age of a pair is the number of mesh cycles since its contact at SAP. */
double stiffness_gears_roll(const stiffness_gears *g, int gear, double age);
/* Returns the equivalent radius of curvature of the contact of a pair of that age on the line of
   action, m. */
double stiffness_gears_curvature(const stiffness_gears *g, double age);

/* Finds the contact of a pair of any age with perfect flanks: the roll angles of both flanks, and
   the gap along the line of action. Before SAP and after the tip, the tip corner of one tooth meets
   the flank of the other off the line of action. Returns false if the corner misses the flank. */
bool stiffness_gears_contact(const stiffness_gears *g, double age, double roll[2], double *gap);

#endif
