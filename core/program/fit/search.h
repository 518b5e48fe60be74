/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least-squares fit of ln(eta) over the free parameters of one law. */
#ifndef FIT_SEARCH_H
#define FIT_SEARCH_H

#include "fit.h"

enum { FIT_MOST_FREE = 12 };

/* A free parameter. The search uses its logarithm if it cannot be negative. */
typedef struct fit_axis {
    size_t param;
    bool log;
    double low, high; /* limits of the search */
    double from, to;  /* range in which searches start: the calibrated range */
    double least;     /* the lower limit as a value; it may be 0 although the search uses the
                         logarithm */
} fit_axis;

typedef struct fit_search {
    fit *fit;
    const fit_data *data; /* data to be fitted */
    fit_law *law;
    double *values; /* values of all parameters; NaN: the law's own */
    double *ln_eta; /* ln(eta) of the law at each point */
    fit_axis axes[FIT_MOST_FREE];
    size_t count;
} fit_search;

/* regress.c: finds the parameters of a law. Returns false with the reason in `why`. */
bool fit_regress(fit *f, fit_law *law);

fit_axis fit_axis_of(const fit_param *param, size_t index);
double fit_axis_value(const fit_axis *axis, double x);

/* Computes the n weighted residuals, with the parameters clipped to their limits. Returns false if
   the law refuses them. */
bool fit_search_residuals(fit_search *s, const double *x, double *out);
/* Computes the derivatives of the residuals, n x count, by central differences. */
void fit_search_jacobian(fit_search *s, const double *x, double *out);
/* Searches for the best minimum from many starts. Returns false if none was found. */
bool fit_search_run(fit_search *s, double *x);

#endif
