/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Statistics of outputs under uncertain inputs, each with a 95 % interval. Cheaper models may serve
 * as control variates (multi-fidelity Monte Carlo: Ng & Willcox 2014; Peherstorfer, Willcox &
 * Gunzburger 2016, SIAM J. Sci. Comput. 38, A3163). Level 0 is the model whose statistics are
 * wanted. The other levels may be wrong: this costs samples, not correctness.
 */
#ifndef STUDY_ESTIMATE_H
#define STUDY_ESTIMATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    ESTIMATE_MOST_LEVELS = 6,
    ESTIMATE_MOST_INPUTS = 32,
    ESTIMATE_SAMPLES_EACH = 3, /* for each term of a surface: with fewer, the errors of the terms
                                  outweigh their gain */
    ESTIMATE_LEAST = 8         /* least number of samples for a variance */
};

typedef struct estimate {
    double value, low, high; /* infinite: the samples give no bound; NaN: not known */
    double error;            /* standard error of a mean */
} estimate;

/* Distribution of an input: normal or nearly normal, uniform, or one of a few values. */
typedef enum { ESTIMATE_NORMAL, ESTIMATE_EVEN, ESTIMATE_STEPS } estimate_shape;

/* An input for a surface. Groups of inputs are independent of each other. */
typedef struct estimate_input {
    size_t group;
    estimate_shape shape;
    size_t steps;       /* equal shares of probability, each with one value */
    const size_t *step; /* number of the value at each of these shares; unused by other shapes */
} estimate_input;

/* Answers of each level for the same inputs. Level k has samples 0 to count[k] - 1, and the counts
   rise from level to level. NaN marks a failed case; its sample is left out on all levels. */
typedef struct estimate_samples {
    size_t levels;
    size_t count[ESTIMATE_MOST_LEVELS];
    const double *values[ESTIMATE_MOST_LEVELS];
    /* Independent standard normal numbers from which the samples of the last level were made, and
     * their number for each sample. The mean uses them as control variates; if the number is 0, it
     * does not. */
    size_t inputs;
    const estimate_input *input;
    const double *numbers;
} estimate_samples;

/* Answers of a pilot: the first samples on all levels. */
typedef struct estimate_pilot {
    size_t levels, count;
    const double *values[ESTIMATE_MOST_LEVELS];
    size_t inputs;
    const estimate_input *input;
    const double *numbers;
} estimate_pilot;

/* The levels that are worth their cost, and the number of samples of each. */
typedef struct estimate_plan {
    size_t levels;
    size_t level[ESTIMATE_MOST_LEVELS];       /* level[0] = 0 */
    size_t count[ESTIMATE_MOST_LEVELS];       /* rising */
    double correlation[ESTIMATE_MOST_LEVELS]; /* correlation of every level with level 0 in the
                                                 pilot */
    double cost;                              /* cost of these samples, in cases of level 0 */
} estimate_plan;

/* Means of pairs of values, and the sums of squares and products about these means. */
typedef struct estimate_moments {
    double count, mean_a, mean_b, aa, bb, ab;
} estimate_moments;

/* Moments of the values, or of g of the values if g is given; pairs with a NaN are left out. */
estimate_moments estimate_pairs(const double *a, const double *b, size_t count,
                                double (*g)(double, double), double about);

/* Correlation of two levels. Its square is corrected for the two degrees of freedom of the fitted
   line; 0 if no correlation is seen. */
double estimate_correlation(const double *a, const double *b, size_t count);

/* The statistics that must be as accurate as from plain samples: only the mean, which needs the
 * fewest samples, or also percentiles and probabilities. */
typedef enum { ESTIMATE_MEAN, ESTIMATE_DISTRIBUTION } estimate_aim;

/* Plans samples for the standard error that `plain` samples of level 0 alone would have; the
   pilot's samples are the first of them. `cost` is the cost of a case of each level, relative to a
   case of level 0. */
estimate_plan estimate_allocate(const estimate_pilot *pilot, const double *cost, size_t plain,
                                estimate_aim aim);

/* The effect of a surface on a mean of values from which their explained parts are subtracted. */
typedef struct estimate_explanation {
    double left;   /* remaining share of the variance of the mean */
    double growth; /* variance of the mean, relative to a mean of independent residuals; it includes
                      the errors of the surface */
    size_t terms;  /* degrees of freedom that the surface uses; 0: there is no surface */
} estimate_explanation;

/* estimate-surface.c: writes to `part` the part of each value that a surface over the numbers from
   which they were made explains. The parts have the mean 0. All parts are 0 if there are too few
   samples; the part of a NaN is NaN. */
estimate_explanation estimate_explained(const double *values, const double *numbers, size_t count,
                                        const estimate_input *inputs, size_t input_count,
                                        double *part);

estimate estimate_mean(const estimate_samples *s);
estimate estimate_deviation(const estimate_samples *s); /* the standard deviation */
/* Returns the probability of a value of at most `limit`. */
estimate estimate_probability(const estimate_samples *s, double limit);
/* Writes the values from which the two are computed, on the scale of level 0: at most as many as
   the level has samples. Returns their number. */
size_t estimate_values(const estimate_samples *s, double *values);
/* Returns the value that a given share (0 to 1) of the values does not exceed. */
estimate estimate_percentile(const estimate_samples *s, double share);

/* First and total index of each group of inputs (Sobol), from a surface through values and the
 * standard normal numbers from which they were made, `input_count` for each. Their intervals
 * include the missing terms of the surface. All are NaN if no surface can be fitted. Returns the
 * number of samples used. */
size_t estimate_shares(const double *values, const double *numbers, size_t count,
                       const estimate_input *inputs, size_t input_count, size_t groups,
                       estimate *first, estimate *total);

#endif
