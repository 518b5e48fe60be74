/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Derivatives of a law by differences, the check on those that the law gives. */
#ifndef TEST_DIFFERENCE_H
#define TEST_DIFFERENCE_H

/* Central differences at steps h and h/2 with Richardson's extrapolation: error O(h^4). */
static inline double difference(double (*f)(const void *, double), const void *ctx, double x,
                                double h)
{
    double coarse = (f(ctx, x + h) - f(ctx, x - h)) / (2 * h);
    double fine = (f(ctx, x + h / 2) - f(ctx, x - h / 2)) / h;
    return (4 * fine - coarse) / 3;
}

#endif
