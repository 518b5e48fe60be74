/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The involute of a circle over its roll angle, which is the tangent of its pressure angle. */
#ifndef STIFFNESS_INVOLUTE_H
#define STIFFNESS_INVOLUTE_H

#include <math.h>

/* Polar angle between the start of the involute and its point at that roll angle, tan a - a. */
static inline double stiffness_involute(double roll)
{
    return roll - atan(roll);
}

#endif
