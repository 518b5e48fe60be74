/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.fitter/1": the parameters of laws from measured data.
 *
 * A model of the kind "fitter" that offers it is no stage of a pipeline: `flankfilm fit KIND FILE`
 * uses fitter/KIND. The program reads the table that the fitter asks for and makes laws out of
 * parameters; the fitter says what it found. All numbers are coherent SI, angles in rad, unless
 * said otherwise. A law is any model that offers the service which the fitter names and that takes
 * no inputs: the fitter knows nothing of it but its rows.
 *
 *     double values[] = {5e-3, 11e-9};                  // a number for each parameter
 *     const ff_viscosity *law = fit->open(fit->ctx, 0, values);
 *     if (law)
 *         law->eval(law->self, ...);
 */
#ifndef FLANKFILM_FITTER_H
#define FLANKFILM_FITTER_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FF_FITTER_ID "flankfilm.fitter/1"

/* What the user says of a parameter of a law, and what became of it. */
enum {
    FF_FIT_UNSAID = 0,  /* the fitter decides; found: it was left out, or is its preset */
    FF_FIT_HELD = 1,    /* it has the value that was given */
    FF_FIT_FREE = 2,    /* it is to be found; found: from the data */
    FF_FIT_AT_LIMIT = 3 /* found: the data want it beyond its limit */
};

typedef struct ff_fit_param {
    size_t size;
    const ff_param *row;
    double factor, offset; /* of the row's unit: SI = factor number + offset */
    int32_t said;          /* FF_FIT_UNSAID, FF_FIT_HELD or FF_FIT_FREE */
    double value;          /* that it is held at; NaN: none, or no number */
} ff_fit_param;

typedef struct ff_fit_law {
    size_t size;
    const char *id; /* "viscosity/roelands" */
    const ff_fit_param *const *params;
    size_t param_count;
} ff_fit_law;

/* A parameter of a law as it was found. */
typedef struct ff_fit_value {
    size_t size;
    double value;     /* NaN: left out, or no number */
    double low, high; /* 95 % confidence interval; NaN: none */
    int32_t how;      /* FF_FIT_UNSAID ... */
} ff_fit_value;

typedef struct ff_fit_found {
    size_t size;
    size_t law;
    const char *why; /* NULL: it was fitted; else one sentence why not, and the rest is unset */
    const ff_fit_value *const *values; /* one per parameter */
    const double *correlation; /* of the estimates, a row and a column for each parameter of the
                                  law; NaN for what was not found */
    size_t free_count;         /* parameters that were found */
    double rms, largest;       /* relative deviation of the data from the law */
    size_t largest_row;
    double criterion; /* by which laws are compared; the smallest is the best */
    double asked;     /* what the law says where the user asked; NaN: not asked */
    const char *note; /* sentences on what to mind, one a line; "" without */
} ff_fit_found;

/* What is to be fitted; valid until `fit` returns. */
typedef struct ff_fit {
    size_t size;
    void *ctx;          /* first argument of every function below */
    const char *source; /* name of the file, to be shown */
    size_t row_count;
    const double *const *columns; /* of each row of the fitter's table; NULL: the file lacks it */
    const double *at;             /* of each column: where the user asks; NaN: nowhere */
    const ff_fit_law *const *laws;
    size_t law_count;

    /* The service of the law with these values, one per parameter; NaN: what the user holds it at,
       else its preset, else left out. Valid until the next call. NULL: it refuses them, for the
       reason that `why` gives, valid as long. */
    const void *(*open)(void *ctx, size_t law, const double *values);
    const char *(*why)(void *ctx);

    /* Says what is wrong with the data, in one sentence; a row or column of SIZE_MAX: all of it.
       Returns FF_INVALID. */
    ff_status (*refuse)(void *ctx, size_t row, size_t column, const char *text);
    /* Once for each law, in any order. */
    void (*found)(void *ctx, const ff_fit_found *found);
    /* A text file of results: "card.yaml". */
    void (*file)(void *ctx, const char *name, const char *text);
} ff_fit;

typedef struct ff_fitter {
    size_t size;
    void *self;
    /* The columns that it reads, as rows of parameters; what the program makes of them and of the
       file: table.h. */
    const ff_param *columns;
    size_t column_count, column_stride;
    size_t quantity;       /* the column that the law gives, in SI: the unit of `asked` */
    const char *service;   /* that a law must offer: "flankfilm.viscosity/1" */
    const char *laws;      /* fitted unless the user names some: "viscosity/barus|..." */
    const char *criterion; /* name of the figure by which laws are compared: "AICc" */
    /* FF_OK, or a status after host->fail or refuse. */
    ff_status (*fit)(void *self, const ff_fit *fit);
} ff_fitter;

#ifdef __cplusplus
}
#endif
#endif
