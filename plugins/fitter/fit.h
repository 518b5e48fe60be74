/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A fit of viscosity laws, as the files of this folder share it. */
#ifndef FIT_H
#define FIT_H

#include <flankfilm/author.h>
#include <flankfilm/fitter.h>
#include <flankfilm/viscosity.h>

#include <stdbool.h>
#include <stdio.h>

enum { FIT_MOST_FREE = 12, FIT_MOST_ROWS = 10000 };

/* The rows that are fitted. */
typedef struct fit_data {
    size_t n;
    double *p, *T;         /* Pa, K; T NULL: no such column */
    double *ln_eta, *root; /* ln(eta / 1 Pa s), square root of the weight; mean weight 1 */
    size_t *row;           /* of the table */
    double highest;        /* pressure, Pa */
    bool isothermal;       /* one temperature, or none given */
    double temperature;    /* K, of one isotherm; NaN: unknown or several */
    bool uncertain;        /* the weights stem from stated uncertainties, of this mean: */
    double uncertainty;
} fit_data;

/* A law as it was fitted. */
typedef struct fit_regression {
    size_t law, params;
    ff_fit_value *values; /* one per parameter */
    const ff_fit_value **value_rows;
    double *correlation;
    double *residual; /* ln(eta) of the data minus that of the law, n */
    size_t free_count;
    double rms, largest, criterion, asked;
    size_t largest_row; /* of the data */
    char why[400], note[2000];
} fit_regression;

/* Finds the parameters. False: `why` says why not. */
bool fit_regress(const ff_fit *fit, const fit_data *data, fit_regression *result);

/* The rank of a column in the table of viscosity.c. */
enum { FIT_PRESSURE, FIT_VISCOSITY, FIT_TEMPERATURE, FIT_UNCERTAINTY, FIT_WEIGHT, FIT_COLUMNS };

/* card.c: the texts of the result files, to be freed; NULL: no memory. */
char *fit_card(const ff_fit *fit, const fit_data *data, const fit_regression *laws);
char *fit_residual_table(const ff_fit *fit, const fit_data *data, const fit_regression *laws);
/* plot.c */
char *fit_residual_plot(const ff_fit *fit, const fit_data *data, const fit_regression *laws);

#endif
