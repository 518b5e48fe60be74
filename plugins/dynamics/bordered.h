/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bordered Newton solves of the return map in (delta, rate, lambda), and the tangent of its curve.
 */
#ifndef DYNAMICS_BORDERED_H
#define DYNAMICS_BORDERED_H

#include "curve.h"

/* The curve about a point, in (delta/unit, rate/unit, lambda). */
typedef struct dynamics_frame {
    double origin[3], unit;
} dynamics_frame;

double dynamics_dot(const double a[3], const double b[3]);

dynamics_frame dynamics_frame_at(const dynamics_excitation *excitation, const dynamics_point *p);

/* Newton's method from z (in the frame) on the plane through it that `border` is normal to, until
   the return is met to `tolerance`. `z` and the orbit, whose period is set, are the solution then;
   0: not found nearby. */
int dynamics_bordered_newton(const dynamics_flow *flow, const dynamics_frame *f,
                             const double border[3], double tolerance, double z[3],
                             dynamics_orbit *o);

/* The null vector of the return's derivative, turned along `along` (not scaled); 0: none. */
int dynamics_curve_tangent(const dynamics_orbit *o, double unit, const double along[3],
                           double tangent[3]);

#endif
