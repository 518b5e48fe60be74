/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares of ln(eta) over the free parameters of one law. */
#ifndef FIT_SEARCH_H
#define FIT_SEARCH_H

#include "fit.h"

enum { FIT_MOST_FREE = 12 };

/* A free parameter. The search uses its logarithm if it cannot be negative. */
typedef struct fit_axis {
    size_t param;
    bool log;
    double low, high; /* limits of the search */
    double from, to;  /* range in which searches start: the calibrated one */
    double least;     /* the lower limit as a value; 0 is possible although the search uses the
                         logarithm */
} fit_axis;

typedef struct fit_search {
    fit *fit;
    const fit_data *data; /* the data to be fitted */
    fit_law *law;
    double *values; /* values of all parameters; NaN: the law's own */
    double *ln_eta; /* ln(eta) of the law at each point */
    fit_axis axes[FIT_MOST_FREE];
    size_t count;
} fit_search;

/* regress.c: finds the parameters of a law. False: `why` gives the reason. */
bool fit_regress(fit *f, fit_law *law);

fit_axis fit_axis_of(const fit_param *param, size_t index);
double fit_axis_value(const fit_axis *axis, double x);

/* The n weighted residuals, with the parameters clipped to their limits. False if the law refuses
   them. */
bool fit_search_residuals(fit_search *s, const double *x, double *out);
/* The derivatives of the residuals, n x count, by central differences. */
void fit_search_jacobian(fit_search *s, const double *x, double *out);
/* Searches from many starts for the best minimum. False if none was reached. */
bool fit_search_run(fit_search *s, double *x);

#endif
