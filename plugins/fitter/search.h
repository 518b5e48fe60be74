/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares of ln(eta) over the free parameters of one law. */
#ifndef FF_SEARCH_H
#define FF_SEARCH_H

#include "fit.h"

/* A free parameter. Where it cannot be negative the search runs in its logarithm. */
typedef struct ff_axis {
    size_t param;
    bool log;
    double low, high; /* limits of the search */
    double from, to;  /* where it starts: the calibrated range */
    double least;     /* the lower limit as a value; of a logarithm it may be 0 */
} ff_axis;

typedef struct ff_search {
    const ff_fit *fit;
    const ff_data *data;
    size_t law;
    double *values; /* of all parameters, SI; NaN: left to the law */
    double *ln_eta; /* room for n numbers */
    ff_axis axes[FF_FIT_MOST_FREE];
    size_t count;
} ff_search;

ff_axis ff_axis_of(const ff_fit_param *param, size_t index);
double ff_axis_value(const ff_axis *axis, double x);

/* The weighted residuals, n, with the parameters clipped to their limits. False: refused there. */
bool ff_search_residuals(ff_search *s, const double *x, double *out);
/* Their derivatives, n x count, by central differences. */
void ff_search_jacobian(ff_search *s, const double *x, double *out);
/* From many starts to the best of the minima. False: none was reached. */
bool ff_search_run(ff_search *s, double *x);

#endif
