/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A smooth curve through measured points that does not overshoot them. */
#ifndef LUBRICANT_CURVE_H
#define LUBRICANT_CURVE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct lubricant_curve {
    size_t n; /* 0: no curve */
    double *x, *y, *slope;
    double *square, *cube; /* coefficients from each point to the next */
} lubricant_curve;

/* Copies n >= 1 points with increasing x. Returns false if out of memory. */
bool lubricant_curve_make(lubricant_curve *c, size_t n, const double *x, const double *y);
void lubricant_curve_free(lubricant_curve *c);

/* Evaluates n points. Beyond its ends the curve is linear; a curve with one point is constant. */
void lubricant_curve_values(const lubricant_curve *c, size_t n, const double *x, double *y,
                            double *slope);

#endif
