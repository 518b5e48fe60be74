/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Parameters of viscosity laws from measured points of pressure, temperature and viscosity. All
 * numbers are coherent SI. A law is any model that offers a viscosity and takes no inputs.
 */
#ifndef FIT_H
#define FIT_H

#include <flankfilm/engine.h>

#include <jansson.h>

/* The columns of the data. */
enum { FIT_PRESSURE, FIT_VISCOSITY, FIT_TEMPERATURE, FIT_UNCERTAINTY, FIT_WEIGHT, FIT_COLUMNS };

/* What the user asks of a parameter, and what became of it. */
typedef enum fit_state {
    FIT_PRESET,  /* asked: nothing; found: it was left out, or is its preset */
    FIT_HELD,    /* it has a value that was given */
    FIT_FREE,    /* asked: to be found; found: from the data */
    FIT_AT_LIMIT /* found: the data want it beyond its limit */
} fit_state;

typedef struct fit_param {
    const ff_param *row;
    const ff_unit *unit;
    fit_state asked, found;
    double value;     /* that it is held at, then that was found; NaN: none, or no number */
    double tried;     /* what its law was last told; NaN: nothing */
    double low, high; /* 95 % confidence interval; NaN: none */
} fit_param;

typedef struct fit_law {
    ff_instance *instance;
    const ff_loaded *loaded; /* its model */
    char *id;                /* "viscosity/roelands" */
    fit_param *params;
    size_t param_count;
    char *refusal; /* why the law refused its parameters the last time; NULL: it never did */

    /* what was found */
    char why[400];       /* "" when it was fitted; else one sentence why not: the rest is unset */
    char note[2000];     /* sentences on what to mind, one a line */
    double *correlation; /* of the estimates, a row and a column for each parameter; NaN for what
                            was not found */
    double *residual;    /* ln(eta) of the data minus that of the law, at each point */
    size_t free_count;   /* parameters that were found */
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
    size_t *row;           /* of the table */
    double highest;        /* pressure */
    bool isothermal;       /* one temperature, or none given */
    double temperature;    /* of one isotherm; NaN: unknown or several */
    bool uncertain;        /* the weights stem from stated uncertainties, of this mean: */
    double uncertainty;
} fit_data;

/* Starts zeroed but for the report; what is wrong goes there. */
typedef struct fit {
    ff_report *report;
    const char *path;      /* the file of the data */
    const ff_table *table; /* its numbers */
    const ff_param *rows;  /* of its columns */
    ff_unit units[FIT_COLUMNS];
    double at[FIT_COLUMNS]; /* where the user asks; NaN: nowhere */
    ff_run *settings;       /* what the user says of parameters */
    bool named;             /* the user has named the laws: each of them must be fitted */
    fit_law *laws;
    size_t law_count;
    fit_data data;
} fit;

/* The steps, in this order; each false after an error. */
bool fit_read(fit *f, const char *path);
/* names: "roelands" or "viscosity/roelands"; none: the laws that come with the program. */
bool fit_add_laws(fit *f, ff_engine *engine, const char *const *names, size_t count);
/* "name=value" or "viscosity/barus.name=value"; a value of "free" is to be found. */
bool fit_set(fit *f, ff_engine *engine, const char *const *sets, size_t count);
/* Quantities inside the data, such as "80 degC". */
bool fit_set_conditions(fit *f, const char *const *quantities, size_t count);
bool fit_run(fit *f);
void fit_free(fit *f);

/* Smallest and largest number of a column that is there. */
void fit_range(const fit *f, size_t column, double *low, double *high);
/* The fitted law with the smallest criterion; NULL: none was fitted. */
const fit_law *fit_best(const fit *f);
/* ln(eta) of n points with a value for each parameter; NaN: what the user holds it at, else its
   preset, else left out. False: the law refuses them, see `refusal`. */
bool fit_law_eval(fit *f, fit_law *law, const double *values, size_t n, const double *p,
                  const double *T, double *ln_eta);

/* In the unit of the parameter's row, and back. */
double fit_to_si(const fit_param *param, double number);
double fit_from_si(const fit_param *param, double si);

/* The result files: a card for pipelines, and the residuals as a table. */
void fit_write_card(const fit *f, FILE *out);
void fit_write_residuals(const fit *f, FILE *out);
/* Returns a figure of the residuals, as script.js of the report draws it. */
json_t *fit_figure(const fit *f);
void fit_print(const fit *f);    /* for people, to stdout */
json_t *fit_facts(const fit *f); /* the members of the answer */

#endif
