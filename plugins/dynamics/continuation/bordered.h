/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newton's method for the fixed points of the return map in (delta, rate, lambda), bordered by a
   plane, and the tangent of their curve. */
#ifndef DYNAMICS_BORDERED_H
#define DYNAMICS_BORDERED_H

#include "curve.h"

/* Scaled coordinates about a point of the curve: (delta/unit, rate/unit, lambda). */
typedef struct dynamics_frame {
    double origin[3], unit;
} dynamics_frame;

double dynamics_dot(const double a[3], const double b[3]);

dynamics_frame dynamics_frame_at(const dynamics_excitation *excitation, const dynamics_point *p);

/* Solves from z (in the frame), on the plane through it with the normal `border`, until the motion
   meets its start to `tolerance`. Then z and the orbit, whose period is set, are the solution; 0:
   none was found nearby. */
int dynamics_bordered_newton(const dynamics_flow *flow, const dynamics_frame *f,
                             const double border[3], double tolerance, double z[3],
                             dynamics_orbit *o);

/* The null vector of the derivative of the return, in the direction of `along` (not scaled); 0:
   there is none. */
int dynamics_curve_tangent(const dynamics_orbit *o, double unit, const double along[3],
                           double tangent[3]);

#endif
