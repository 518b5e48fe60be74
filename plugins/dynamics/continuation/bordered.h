/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newton's method for fixed points of the return map in (delta, rate, lambda). The third equation
   is a plane in this space (bordering). The tangent of the curve of fixed points is computed here,
   too. */
#ifndef DYNAMICS_BORDERED_H
#define DYNAMICS_BORDERED_H

#include "curve.h"

/* A frame of scaled coordinates around a point of the curve: (delta/unit, rate/unit, lambda). */
typedef struct dynamics_frame {
    double origin[3], unit;
    int moments; /* 1: the rms of the solution is computed too */
} dynamics_frame;

double dynamics_dot(const double a[3], const double b[3]);

dynamics_frame dynamics_frame_at(const dynamics_excitation *excitation, const dynamics_point *p);

void dynamics_scaled_tangent(const dynamics_frame *f, const dynamics_point *p, double tangent[3]);

/* Predicts the point at arclength s along the tangent `border` of the frame's origin. The
   prediction is the cubic through the origin and `other` with both tangents. If the tangents differ
   by a large angle, it is the parabola through both points with the tangent at the origin. */
void dynamics_point_of_cubic(const dynamics_frame *f, const double border[3],
                             const dynamics_point *other, double s, double z[3]);

/* Solves for the point of the curve on the plane through z with the normal `border`, until the
   residual of the motion is below `tolerance`. z is given in coordinates of the frame, and the
   orbit with its period. Both are replaced by the solution. Returns 0 if no solution was found
   nearby. */
int dynamics_bordered_newton(const dynamics_flow *flow, const dynamics_frame *f,
                             const double border[3], double tolerance, double z[3],
                             dynamics_orbit *o);

/* Computes the tangent of the curve, not scaled: the null vector of the derivative of the
   fixed-point equation. The tangent points to the same side as `along`. Returns 0 if there is no
   tangent. */
int dynamics_curve_tangent(const dynamics_orbit *o, double unit, const double along[3],
                           double tangent[3]);

#endif
