/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newton's method for fixed points of the return map in (delta, rate, lambda), bordered by a plane,
 * and the tangent of their curve. */
#ifndef DYNAMICS_BORDERED_H
#define DYNAMICS_BORDERED_H

#include "curve.h"

/* Scaled coordinates about a point of the curve: (delta/unit, rate/unit, lambda). */
typedef struct dynamics_frame {
    double origin[3], unit;
    int moments; /* 1: the solution may get its rms */
} dynamics_frame;

double dynamics_dot(const double a[3], const double b[3]);

dynamics_frame dynamics_frame_at(const dynamics_excitation *excitation, const dynamics_point *p);

void dynamics_scaled_tangent(const dynamics_frame *f, const dynamics_point *p, double tangent[3]);

/* Predicts the point at arclength s along the tangent `border` of the frame's origin. The
 * prediction is the cubic through the origin and `other` with both tangents. If the tangent at
 * `other` has turned far it is the parabola through `other` alone. */
void dynamics_point_of_cubic(const dynamics_frame *f, const double border[3],
                             const dynamics_point *other, double s, double z[3]);

/* Solves from z (in the frame) on the plane through z with the normal `border`, until the residual
 * of the motion is below `tolerance`. The orbit's period is given. z and the orbit become the
 * solution. 0: none was found nearby. */
int dynamics_bordered_newton(const dynamics_flow *flow, const dynamics_frame *f,
                             const double border[3], double tolerance, double z[3],
                             dynamics_orbit *o);

/* Gives the null vector of the derivative of the return, in the direction of `along` (not scaled).
 * 0: there is none. */
int dynamics_curve_tangent(const dynamics_orbit *o, double unit, const double along[3],
                           double tangent[3]);

#endif
