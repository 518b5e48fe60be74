/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Fits parameters of viscosity laws to measured points of pressure, temperature and viscosity. All
 * numbers are coherent SI. A law is any model that provides a viscosity and has no inputs.
 */
#ifndef FIT_H
#define FIT_H

#include <flankfilm/engine.h>

#include <jansson.h>

/* The columns of the data. */
enum { FIT_PRESSURE, FIT_VISCOSITY, FIT_TEMPERATURE, FIT_UNCERTAINTY, FIT_WEIGHT, FIT_COLUMNS };

/* State of a parameter, in the user's request and in the result of the fit. */
typedef enum fit_state {
    FIT_PRESET,  /* requested: nothing; result: omitted, or at its preset */
    FIT_HELD,    /* kept at a given value */
    FIT_FREE,    /* requested: to be found; result: found from the data */
    FIT_AT_LIMIT /* result: the data fit best beyond its limit */
} fit_state;

typedef struct fit_param {
    const ff_param *row;
    const ff_unit *unit;
    fit_state asked, found;
    double value;     /* the given value, or the value found; NaN: none, or not a number */
    double tried;     /* value last passed to its law; NaN: none */
    double low, high; /* 95 % confidence interval; NaN: none */
} fit_param;

typedef struct fit_law {
    ff_instance *instance;
    const ff_loaded *loaded; /* its model */
    char *id;                /* "viscosity/roelands" */
    fit_param *params;
    size_t param_count;
    char *refusal; /* why the law last refused its parameters; NULL if it never did */

    /* "" if it was fitted, else one sentence with the reason, and the other results are not set */
    char why[400];       /* "" if it was fitted, else one sentence with the reason, and the other
                            results are not set */
    char note[2000];     /* remarks, one sentence a line */
    double *correlation; /* correlation of the estimates, a row and a column for each parameter;
                            NaN if it was not found */
    double *residual;    /* ln(eta) of the data minus ln(eta) of the law, at each point */
    size_t free_count;   /* number of parameters found */
    double rms, largest; /* relative deviation of the data from the law */
    size_t largest_row;  /* row of the table with the largest deviation */
    double criterion;    /* AICc; the smallest is the best */
    double asked;        /* viscosity at the requested conditions; NaN: not requested */
} fit_law;

/* The rows to be fitted. */
typedef struct fit_data {
    size_t n;
    double *p, *T;         /* T NULL: no such column */
    double *ln_eta, *root; /* ln(eta / 1 Pa s); square root of the weight, with a mean weight of
                              1 */
    size_t *row;           /* row number in the table */
    double highest;        /* highest pressure */
    bool isothermal;       /* whether all rows have one temperature, or none is given */
    double temperature;    /* temperature of the only isotherm; NaN: not known, or several */
    bool uncertain;        /* whether the weights come from stated uncertainties; their mean: */
    double uncertainty;
} fit_data;

/* The data of a fit. All members start zeroed except the report, which receives the errors. */
typedef struct fit {
    ff_report *report;
    const char *path;      /* path of the data file */
    const ff_table *table; /* numbers of the data file */
    const ff_param *rows;  /* units and dimensions of the columns */
    ff_unit units[FIT_COLUMNS];
    double at[FIT_COLUMNS]; /* requested conditions; NaN: none */
    ff_run *settings;       /* the user's settings of parameters */
    bool named;             /* whether the user named the laws; each of them must then be fitted */
    fit_law *laws;
    size_t law_count;
    fit_data data;
} fit;

/* The steps of a fit, in this order; each returns false after an error. */
bool fit_read(fit *f, const char *path);
/* Adds laws by name: "roelands" or "viscosity/roelands"; without names: the laws installed with the
   program. */
bool fit_add_laws(fit *f, ff_engine *engine, const char *const *names, size_t count);
/* Applies settings "name=value" or "viscosity/barus.name=value". The value "free" makes the
   parameter one to be found. */
bool fit_set(fit *f, ff_engine *engine, const char *const *sets, size_t count);
/* Sets conditions inside the data, such as "80 degC". */
bool fit_set_conditions(fit *f, const char *const *quantities, size_t count);
bool fit_run(fit *f);
void fit_free(fit *f);

/* Sets the smallest and largest number of a column in the data. */
void fit_range(const fit *f, size_t column, double *low, double *high);
/* Returns the fitted law with the smallest criterion, or NULL if none was fitted. */
const fit_law *fit_best(const fit *f);
/* Computes ln(eta) of n points for given values of all parameters. NaN stands for the value set
   by the user, else the preset, else no value. Returns false if the law refuses them: see
   `refusal`. */
bool fit_law_eval(fit *f, fit_law *law, const double *values, size_t n, const double *p,
                  const double *T, double *ln_eta);

/* The result files: a card for pipelines, and the residuals as a table. */
void fit_write_card(const fit *f, FILE *out);
void fit_write_residuals(const fit *f, FILE *out);
/* Returns a figure of the residuals for script.js of the report. */
json_t *fit_figure(const fit *f);
void fit_print(const fit *f);    /* prints the fit to stdout */
json_t *fit_facts(const fit *f); /* returns the members of the JSON answer */

#endif
