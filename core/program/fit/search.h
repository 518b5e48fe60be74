/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares of ln(eta) over the free parameters of one law. */
#ifndef FIT_SEARCH_H
#define FIT_SEARCH_H

#include "fit.h"

enum { FIT_MOST_FREE = 12 };

/* A free parameter. The search runs in its logarithm when it cannot be negative. */
typedef struct fit_axis {
    size_t param;
    bool log;
    double low, high; /* limits of the search */
    double from, to;  /* range in which a search starts: the calibrated one */
    double least;     /* the lower limit as a value; of a logarithm it may be 0 */
} fit_axis;

typedef struct fit_search {
    fit *fit;
    const fit_data *data; /* of the fit */
    fit_law *law;
    double *values; /* of all parameters; NaN: the law has its own */
    double *ln_eta; /* at each point, by the law */
    fit_axis axes[FIT_MOST_FREE];
    size_t count;
} fit_search;

/* regress.c: finds the parameters of a law. False: its `why` says why not. */
bool fit_regress(fit *f, fit_law *law);

fit_axis fit_axis_of(const fit_param *param, size_t index);
double fit_axis_value(const fit_axis *axis, double x);

/* The weighted residuals, n, with the parameters clipped to their limits. False: refused there. */
bool fit_search_residuals(fit_search *s, const double *x, double *out);
/* Their derivatives, n x count, by central differences. */
void fit_search_jacobian(fit_search *s, const double *x, double *out);
/* From many starts to the best of the minima. False: none was reached. */
bool fit_search_run(fit_search *s, double *x);

#endif
