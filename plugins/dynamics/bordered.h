/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bordered Newton solves of the return map in (delta, rate, lambda), and the tangent of its curve.
 */
#ifndef FF_DYNAMICS_BORDERED_H
#define FF_DYNAMICS_BORDERED_H

#include "curve.h"

/* The curve about a point, in (delta/unit, rate/unit, lambda). */
typedef struct ff_frame {
    double origin[3], unit;
} ff_frame;

double ff_dot(const double a[3], const double b[3]);

ff_frame ff_frame_at(const ff_mesh *mesh, const ff_point *p);

/* Newton's method from z (in the frame) on the plane through it that `border` is normal to, until
   the return is met to `tolerance`. `z` and the orbit, whose period is set, are the solution then;
   0: not found nearby. */
int ff_correct(const ff_flow *flow, const ff_frame *f, const double border[3], double tolerance,
               double z[3], ff_orbit *o);

/* The null vector of the return's derivative, turned along `along` (not scaled); 0: none. */
int ff_tangent_at(const ff_orbit *o, double unit, const double along[3], double tangent[3]);

#endif
