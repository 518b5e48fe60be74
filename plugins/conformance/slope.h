/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The derivative of a law by differences. */
#ifndef SLOPE_H
#define SLOPE_H

#include "kernel.h"

/* The value of a kernel along one axis through a point. */
typedef struct line {
    const law_kernel *kernel;
    const void *table;
    double speed, point[KERNEL_AXES];
    bool absent[KERNEL_AXES]; /* optional arguments that are NULL */
    size_t axis;
} line;

double slope_value(const line *l, double x, double out[KERNEL_RESULTS]);

/* Compares a derivative with differences about the point, first over `h`. 0: agrees; 1: does not;
   2: the differences are too rough to tell, as beside a kink. *found: the differences' answer. */
int slope_compare(const line *l, double claimed, double h, double *found);

#endif
