/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The involute function over the pressure angle, or over the roll angle, which is the tangent of
   the pressure angle. */
#ifndef NUMERICS_INVOLUTE_H
#define NUMERICS_INVOLUTE_H

#include <math.h>

/* Returns the polar angle between the start of the involute and its point at this pressure angle:
   inv a = tan a - a. */
static inline double numerics_involute(double angle)
{
    return tan(angle) - angle;
}

/* Returns this polar angle for a roll angle. */
static inline double numerics_involute_at_roll(double roll)
{
    return roll - atan(roll);
}

/* Returns the angle a between 0 and pi/2 with tan a - a = value, for value > 0. With t = tan a,
   g(t) = t - atan t - value is increasing and convex, and g > 0 at the start. Newton's method
   therefore approaches the root from above. */
static inline double numerics_involute_inverse(double value)
{
    double t = value + M_PI_2;
    for (int i = 0; i < 200; i++) {
        double step = (t - atan(t) - value) * (1 + t * t) / (t * t);
        if (!(step > 0))
            break;
        t -= step;
    }
    return atan(t);
}

#endif
