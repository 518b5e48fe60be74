/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Statistics of what uncertain inputs make of an output, each with a 95 % interval. Cheaper models
 * may serve as control variates (multi-fidelity Monte Carlo: Ng & Willcox 2014; Peherstorfer,
 * Willcox & Gunzburger 2016, SIAM J. Sci. Comput. 38, A3163). Level 0 is the model whose statistics
 * are wanted; the others may be wrong, which costs samples and no truth.
 */
#ifndef STUDY_ESTIMATE_H
#define STUDY_ESTIMATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { ESTIMATE_MOST_LEVELS = 6, ESTIMATE_LEAST = 8 /* samples that a variance is taken from */ };

typedef struct estimate {
    double value, low, high; /* infinite ends are not bounded by the samples; NaN: not known */
    double error;            /* standard error of a mean */
} estimate;

/* What each level gave for the same inputs. The first levels of a sample are missing beyond their
   count: they rise from level to level, and level k has samples 0 to count[k] - 1. NaN where a case
   failed: then its sample is left out on all levels. */
typedef struct estimate_samples {
    size_t levels;
    size_t count[ESTIMATE_MOST_LEVELS];
    const double *values[ESTIMATE_MOST_LEVELS];
    /* what the samples of the last level were made from: so many independent standard normal
       numbers each, sample by sample. The mean takes them as control variates; 0: it does not. */
    size_t inputs;
    const double *numbers;
} estimate_samples;

/* What a pilot gave: the first samples, on all levels. */
typedef struct estimate_pilot {
    size_t levels, count;
    const double *values[ESTIMATE_MOST_LEVELS];
    size_t inputs;
    const double *numbers;
} estimate_pilot;

/* Which levels are worth their cost, and how many samples of each. */
typedef struct estimate_plan {
    size_t levels;
    size_t level[ESTIMATE_MOST_LEVELS];       /* level[0] = 0 */
    size_t count[ESTIMATE_MOST_LEVELS];       /* rise */
    double correlation[ESTIMATE_MOST_LEVELS]; /* of every level with level 0, in the pilot */
    double cost;                              /* of these samples, in cases of level 0 */
} estimate_plan;

/* Means of pairs of values, and the sums of squares and products about them. */
typedef struct estimate_moments {
    double count, mean_a, mean_b, aa, bb, ab;
} estimate_moments;

/* Of g of the values, or of themselves where g is NULL; pairs with a NaN are left out. */
estimate_moments estimate_pairs(const double *a, const double *b, size_t count,
                                double (*g)(double, double), double about);

/* The correlation of two levels. Its square allows for the two degrees of freedom of the line that
   is fitted; 0 where no correlation is seen. */
double estimate_correlation(const double *a, const double *b, size_t count);

/* What is to be known as well as from plain samples: the mean alone, which takes the fewest, or
   percentiles and probabilities, too. */
typedef enum { ESTIMATE_MEAN, ESTIMATE_DISTRIBUTION } estimate_aim;

/* Plans for the standard error that `plain` samples of level 0 alone have; those of the pilot are
   the first. `cost` is that of a case of each level over one of level 0. */
estimate_plan estimate_allocate(const estimate_pilot *pilot, const double *cost, size_t plain,
                                estimate_aim aim);

/* estimate-inputs.c: the regression of values on the numbers that they were made from, and on their
   squares where there are samples enough. Writes to `part` what of each value the others say that
   its numbers make, which has the mean 0; 0 where there are too few samples, NaN where the value
   is. Returns the share of the variance that the numbers do not explain. */
double estimate_explained(const double *values, const double *numbers, size_t count, size_t inputs,
                          double *part);

estimate estimate_mean(const estimate_samples *s);
estimate estimate_deviation(const estimate_samples *s); /* the standard deviation */
/* The probability of a value of at most `limit`. */
estimate estimate_probability(const estimate_samples *s, double limit);
/* Writes the values of the level that the two come from, on the scale of level 0: as many as the
   level has samples at most; returns their number. */
size_t estimate_values(const estimate_samples *s, double *values);
/* The value that a share from 0 to 1 of the values does not exceed. */
estimate estimate_percentile(const estimate_samples *s, double share);

/* First and total Sobol index of each of the groups of inputs, which are independent of each other.
   `a` and `b` have values for independent inputs; c[g * count + i] is for the inputs of a[i], those
   of group g being those of b[i]. `seed` is for the resampling that the intervals come from. Rows
   with a NaN are left out. Returns how many rows are left. */
size_t estimate_sobol(const double *a, const double *b, const double *c, size_t count,
                      size_t groups, uint64_t seed, estimate *first, estimate *total);
/* Clips indices that come from so many rows to what they can be: a total to 0 and 1, a first one to
   0 and its total. A first one below 1.96 / sqrt(count), which the correlation of independent rows
   exceeds one time in 20 (its variance is 1 / count), is not told and gets NaN, as do all of them
   where their sum exceeds 1 by as much. One whose total is 0 is 0. */
void estimate_tell_shares(estimate *first, estimate *total, size_t groups, size_t count);

#endif
