/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A smooth curve through measured points that overshoots none of them. */
#ifndef LUBRICANT_CURVE_H
#define LUBRICANT_CURVE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct lubricant_curve {
    size_t n; /* 0: there is no curve */
    double *x, *y, *slope;
    double *square, *cube; /* coefficients from each point to the next */
} lubricant_curve;

/* Copies n >= 1 points of increasing x. False when there is no memory. */
bool lubricant_curve_make(lubricant_curve *c, size_t n, const double *x, const double *y);
void lubricant_curve_free(lubricant_curve *c);

/* At n points. Beyond its ends the curve is straight. Through one point alone it is level. */
void lubricant_curve_values(const lubricant_curve *c, size_t n, const double *x, double *y,
                            double *slope);

#endif
