/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Uncertain inputs: their distributions, and draws of all of them. Inputs depend on each other
 * through the correlations of the normal variates from which they are made (Gaussian copula).
 */
#ifndef STUDY_VARIATE_H
#define STUDY_VARIATE_H

#include "../../run/context.h"

enum { VARIATE_MOST = 32 };

typedef enum { VARIATE_NORMAL, VARIATE_LOGNORMAL, VARIATE_UNIFORM, VARIATE_SAMPLES } variate_kind;

typedef struct variate {
    const char *name;
    const char **paths; /* all receive the same value */
    size_t path_count;
    const char *text; /* "normal: [250 N m, 10 %]" */
    variate_kind kind;
    double a, b;          /* mean and deviation; or median and deviation of the logarithm; or lower
                           * and upper end */
    const char *unit;     /* of these, or "" */
    const char **samples; /* sorted if all are numbers */
    bool words;           /* the samples are words, or numbers of different units */
    size_t sample_count;
    size_t group; /* inputs of different groups are independent */
} variate;

typedef struct variates {
    const ff_node *place; /* the map of inputs, or of the study */
    size_t count, groups;
    variate all[VARIATE_MOST];
    double root[VARIATE_MOST * VARIATE_MOST]; /* Cholesky factor of the correlations, by rows */
} variates;

/* Reads `inputs` and `correlations`, which may be NULL: the inputs are then the values of the
   pipeline that have a tolerance. False after an error. */
bool variates_read(variates *v, study_context *context, const ff_node *inputs,
                   const ff_node *correlations);

/* Draws `count` sets of one standard normal number for each input, independent of each other. A
   longer list begins with the same numbers. To be freed. */
double *variates_draw(const variates *v, uint64_t seed, size_t count);

/* Returns the value of input k in the notation of a file, from such numbers; NULL: its median. */
const char *variates_value(const variates *v, study_context *context, size_t k,
                           const double *numbers);

#endif
