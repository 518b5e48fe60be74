/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the fewest cells and the longest steps with which a film keeps an accuracy. */
#ifndef EHL_TUNE_H
#define EHL_TUNE_H

#include "assess.h"

typedef struct ehl_tuning {
    size_t cells;
    size_t steps;     /* 0: auto */
    double tolerance; /* time tolerance of automatic steps */
    double count;     /* expected number of steps */
    /* relative errors by cells and steps together: of the film on the mean, of its lowest, ... */
    double mean, lowest, pressure, friction;
} ehl_tuning;

/* given: EHL_TUNE_... of what is already set in `t` and stays. */
enum { EHL_TUNE_CELLS = 1, EHL_TUNE_STEPS = 2, EHL_TUNE_TOLERANCE = 4 };
void ehl_tune(const ehl_conditions *s, double accuracy, int given, ehl_error_targets w,
              ehl_tuning *t);
double ehl_tuned_error(const ehl_tuning *t, ehl_error_targets w);

#endif
