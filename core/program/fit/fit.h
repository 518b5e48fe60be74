/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Fits parameters of viscosity laws to measured points of pressure, temperature and viscosity. All
 * numbers are coherent SI. A law is any model that offers a viscosity and takes no inputs.
 */
#ifndef FIT_H
#define FIT_H

#include <flankfilm/engine.h>

#include <jansson.h>

/* The columns of the data. */
enum { FIT_PRESSURE, FIT_VISCOSITY, FIT_TEMPERATURE, FIT_UNCERTAINTY, FIT_WEIGHT, FIT_COLUMNS };

/* A parameter's state, in two roles: what the user asks for, and what the fit found. */
typedef enum fit_state {
    FIT_PRESET,  /* asked: nothing; found: left out, or at its preset */
    FIT_HELD,    /* held at a given value */
    FIT_FREE,    /* asked: to be found; found: from the data */
    FIT_AT_LIMIT /* found: the data want a value beyond its limit */
} fit_state;

typedef struct fit_param {
    const ff_param *row;
    const ff_unit *unit;
    fit_state asked, found;
    double value;     /* the value at which it is held, or the value found; NaN: none, or no
                         number */
    double tried;     /* the value last given to its law; NaN: none */
    double low, high; /* 95 % confidence interval; NaN: none */
} fit_param;

typedef struct fit_law {
    ff_instance *instance;
    const ff_loaded *loaded; /* its model */
    char *id;                /* "viscosity/roelands" */
    fit_param *params;
    size_t param_count;
    char *refusal; /* why the law last refused its parameters; NULL: it never did */

    /* results of the fit */
    char why[400];       /* "" if it was fitted; else one sentence that says why not, and the
                            rest is unset */
    char note[2000];     /* remarks, one sentence a line */
    double *correlation; /* correlation of the estimates, a row and a column for each parameter;
                            NaN if it was not found */
    double *residual;    /* ln(eta) of the data minus ln(eta) of the law, at each point */
    size_t free_count;   /* number of parameters found */
    double rms, largest; /* relative deviation of the data from the law */
    size_t largest_row;  /* of the table */
    double criterion;    /* AICc; the smallest is the best */
    double asked;        /* viscosity where the user asked; NaN: not asked */
} fit_law;

/* The rows that are fitted. */
typedef struct fit_data {
    size_t n;
    double *p, *T;         /* T NULL: no such column */
    double *ln_eta, *root; /* ln(eta / 1 Pa s), square root of the weight; mean weight 1 */
    size_t *row;           /* row in the table */
    double highest;        /* highest pressure */
    bool isothermal;       /* one temperature, or none given */
    double temperature;    /* of one isotherm; NaN: unknown or several */
    bool uncertain;        /* the weights come from stated uncertainties with this mean: */
    double uncertainty;
} fit_data;

/* Starts zeroed but for the report, which receives the errors. */
typedef struct fit {
    ff_report *report;
    const char *path;      /* the file of the data */
    const ff_table *table; /* its numbers */
    const ff_param *rows;  /* the columns' units and dimensions */
    ff_unit units[FIT_COLUMNS];
    double at[FIT_COLUMNS]; /* conditions that the user asks for; NaN: none */
    ff_run *settings;       /* the user's settings of parameters */
    bool named;             /* the user named the laws: each of them must be fitted */
    fit_law *laws;
    size_t law_count;
    fit_data data;
} fit;

/* The steps of a fit, in this order; each returns false after an error. */
bool fit_read(fit *f, const char *path);
/* names: "roelands" or "viscosity/roelands"; none: the laws that come with the program. */
bool fit_add_laws(fit *f, ff_engine *engine, const char *const *names, size_t count);
/* Settings "name=value" or "viscosity/barus.name=value"; the value "free" asks for the parameter to
   be found. */
bool fit_set(fit *f, ff_engine *engine, const char *const *sets, size_t count);
/* Quantities inside the data, such as "80 degC". */
bool fit_set_conditions(fit *f, const char *const *quantities, size_t count);
bool fit_run(fit *f);
void fit_free(fit *f);

/* Smallest and largest number of a column that the data have. */
void fit_range(const fit *f, size_t column, double *low, double *high);
/* The fitted law with the smallest criterion; NULL: none was fitted. */
const fit_law *fit_best(const fit *f);
/* ln(eta) of n points for given values of all parameters. NaN stands for the value that the user
   holds, else the preset, else no value. False if the law refuses them: see `refusal`. */
bool fit_law_eval(fit *f, fit_law *law, const double *values, size_t n, const double *p,
                  const double *T, double *ln_eta);

/* The result files: a card for pipelines, and the residuals as a table. */
void fit_write_card(const fit *f, FILE *out);
void fit_write_residuals(const fit *f, FILE *out);
/* Returns a figure of the residuals for script.js of the report. */
json_t *fit_figure(const fit *f);
void fit_print(const fit *f);    /* for people, to stdout */
json_t *fit_facts(const fit *f); /* the members of the JSON answer */

#endif
