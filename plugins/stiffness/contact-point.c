/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds where a pair of teeth touches. */
#include "contact-point.h"

#include "../numerics/involute.h"

#include <math.h>

double stiffness_gears_roll(const stiffness_gears *g, int gear, double age)
{
    double roll = g->roll_sap + age * g->pitch;
    if (gear == 0)
        return roll;
    return (g->tangent_length - g->gear[0].base_radius * roll) / g->gear[1].base_radius;
}

double stiffness_gears_curvature(const stiffness_gears *g, double age)
{
    double clamped = fmin(fmax(age, 0), g->contact_ratio);
    double r1 = g->gear[0].base_radius * stiffness_gears_roll(g, 0, clamped);
    return r1 * (g->tangent_length - r1) / g->tangent_length;
}

/* Finds the contact of the tip corner of gear `tip` with the flank of the other gear. Both gears
   are turned so that perfect flanks of a pair of that age would meet on the line of action.
   Coordinates: x along the line of action from its tangent point on the base circle of the flank's
   gear, y towards the centre of gear `tip`. */
static bool meet_corner(const stiffness_gears *g, int tip, double age, double roll[2], double *gap)
{
    const stiffness_gear *corner = &g->gear[tip], *flank = &g->gear[1 - tip];
    double radius = corner->base_radius * sqrt(1 + corner->roll_tip * corner->roll_tip);
    /* polar angle of the corner, from the tangent point of the line of action on the base circle of
       its gear */
    double turn = stiffness_gears_roll(g, tip, age) - numerics_involute_at_roll(corner->roll_tip);
    double x = g->tangent_length - radius * sin(turn);
    double y = corner->base_radius - radius * cos(turn) + flank->base_radius;
    double ratio = hypot(x, y) / flank->base_radius;
    if (!(ratio > 1))
        return false;
    roll[tip] = corner->roll_tip;
    roll[1 - tip] = sqrt(ratio * ratio - 1);
    /* the gap is the rotation by which the flank reaches the corner, times the base radius */
    *gap = flank->base_radius * (atan2(x, y) + numerics_involute_at_roll(roll[1 - tip]) -
                                 stiffness_gears_roll(g, 1 - tip, age));
    return true;
}

bool stiffness_gears_contact(const stiffness_gears *g, double age, double roll[2], double *gap)
{
    *gap = 0;
    if (age < 0)
        return meet_corner(g, 1, age, roll, gap);
    if (age > g->contact_ratio)
        return meet_corner(g, 0, age, roll, gap);
    for (int i = 0; i < 2; i++)
        roll[i] = stiffness_gears_roll(g, i, age);
    return true;
}
