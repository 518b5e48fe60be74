/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Uncertain inputs: what each is distributed like, and draws of all of them. Inputs depend on each
 * other by the correlations of the normal variates that they are made from (Gaussian copula).
 */
#ifndef STUDY_VARIATE_H
#define STUDY_VARIATE_H

#include "../../run/context.h"

enum { VARIATE_MOST = 32 };

typedef enum { VARIATE_NORMAL, VARIATE_LOGNORMAL, VARIATE_UNIFORM, VARIATE_SAMPLES } variate_kind;

typedef struct variate {
    const char *name;
    const char **paths; /* all get the same value */
    size_t path_count;
    const char *text; /* "normal: [250 N m, 10 %]" */
    variate_kind kind;
    double a, b;          /* mean and deviation; median and that of the logarithm; both ends */
    const char *unit;     /* of these, or "" */
    const char **samples; /* sorted where all are numbers */
    bool words;           /* they are not numbers of one unit */
    size_t sample_count;
    size_t group; /* inputs of different groups are independent */
} variate;

typedef struct variates {
    const ff_node *place; /* the map of inputs, or of the study */
    size_t count, groups;
    variate all[VARIATE_MOST];
    double root[VARIATE_MOST * VARIATE_MOST]; /* Cholesky factor of the correlations, by rows */
} variates;

/* Reads `inputs` and `correlations`, which may be NULL: the values of the pipeline that have a
   tolerance are the inputs then. False after an error. */
bool variates_read(variates *v, study_context *context, const ff_node *inputs,
                   const ff_node *correlations);

/* Streams of draws that are independent of each other. */
enum { VARIATES_MAIN = 1, VARIATES_FIRST, VARIATES_SECOND };

/* Returns `count` times one standard normal number for each input, independent of each other; the
   first ones of a longer list are the same. To be freed. */
double *variates_draw(const variates *v, uint64_t seed, int stream, size_t count);

/* Returns the value of input k, as a file would say it, from such numbers; NULL for the medians. */
const char *variates_value(const variates *v, study_context *context, size_t k,
                           const double *numbers);

#endif
