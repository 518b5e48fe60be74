/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The least cells and the longest steps with which a film keeps an accuracy. */
#ifndef FF_EHL_TUNE_H
#define FF_EHL_TUNE_H

#include "assess.h"

typedef struct ff_tuning {
    size_t cells;
    size_t steps;     /* 0: auto */
    double tolerance; /* of time, for auto */
    double count;     /* steps to be expected */
    /* errors, of cells and steps together: of the film on the mean, of its lowest, ... */
    double mean, lowest, pressure, friction;
} ff_tuning;

/* given: FF_TUNE_... of what is set already in `t` and stays. */
enum { FF_TUNE_CELLS = 1, FF_TUNE_STEPS = 2, FF_TUNE_TOLERANCE = 4 };
void ff_tune(const ff_scene *s, double accuracy, int given, ff_wishes w, ff_tuning *t);
double ff_tuned_error(const ff_tuning *t, ff_wishes w);

#endif
