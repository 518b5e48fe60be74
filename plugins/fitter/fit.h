/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A fit of viscosity laws, as the files of this folder share it. */
#ifndef FF_FIT_H
#define FF_FIT_H

#include <flankfilm/author.h>
#include <flankfilm/fitter.h>
#include <flankfilm/viscosity.h>

#include <stdbool.h>
#include <stdio.h>

enum { FF_FIT_MOST_FREE = 12, FF_FIT_MOST_ROWS = 10000 };

/* The rows that are fitted. */
typedef struct ff_data {
    size_t n;
    double *p, *T;         /* Pa, K; T NULL: no such column */
    double *ln_eta, *root; /* ln(eta / 1 Pa s), square root of the weight; mean weight 1 */
    size_t *row;           /* of the table */
    double highest;        /* pressure, Pa */
    bool isothermal;       /* one temperature, or none given */
    double temperature;    /* K, of one isotherm; NaN: unknown or several */
    bool uncertain;        /* the weights stem from stated uncertainties, of this mean: */
    double uncertainty;
} ff_data;

/* A law as it was fitted. */
typedef struct ff_regression {
    size_t law, params;
    ff_fit_value *values; /* one per parameter */
    const ff_fit_value **value_rows;
    double *correlation;
    double *residual; /* ln(eta) of the data minus that of the law, n */
    size_t free_count;
    double rms, largest, criterion, asked;
    size_t largest_row; /* of the data */
    char why[400], note[2000];
} ff_regression;

/* Finds the parameters. False: `why` says why not. */
bool ff_regress(const ff_fit *fit, const ff_data *data, ff_regression *result);

/* The rank of a column in the table of viscosity.c. */
enum { FF_PRESSURE, FF_VISCOSITY, FF_TEMPERATURE, FF_UNCERTAINTY, FF_WEIGHT, FF_COLUMNS };

/* card.c: the texts of the result files, to be freed; NULL: no memory. */
char *ff_card(const ff_fit *fit, const ff_data *data, const ff_regression *laws);
char *ff_residual_table(const ff_fit *fit, const ff_data *data, const ff_regression *laws);
/* plot.c */
char *ff_residual_plot(const ff_fit *fit, const ff_data *data, const ff_regression *laws);

#endif
