/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Effect of uncertain inputs on the outputs, compared with the effects of the grid and of the
 * choice of models. The study runs the medians first, with the error bar and with other models,
 * then pilot samples on all levels of a ladder of cheaper models, then as many further samples of
 * each level as the pilot shows to be worth their cost. A surface through the samples gives the
 * share of each input. */
#ifndef STUDY_UNCERTAINTY_H
#define STUDY_UNCERTAINTY_H

#include "../answer/kind.h"
#include "../answer/number.h"
#include "../answer/text.h"
#include "variate.h"

#include "estimates/estimate.h"

_Static_assert((int)VARIATE_MOST <= (int)ESTIMATE_MOST_INPUTS, "a surface uses all inputs");

enum { UNCERTAINTY_MOST_MODELS = 16, UNCERTAINTY_MOST_SHARES = 16, UNCERTAINTY_TEXT = 64 };

enum {
    UNCERTAINTY_OUTPUTS,
    UNCERTAINTY_INPUTS,
    UNCERTAINTY_CORRELATIONS,
    UNCERTAINTY_CONDITIONS,
    UNCERTAINTY_PERCENTILES,
    UNCERTAINTY_SAMPLES,
    UNCERTAINTY_SEED,
    UNCERTAINTY_LADDER,
    UNCERTAINTY_PILOT,
    UNCERTAINTY_AIM,
    UNCERTAINTY_SENSITIVITY,
    UNCERTAINTY_MODELS,
    STUDY_UNCERTAINTY_KEYS
};

/* A level or a model to compare: its differences from the file; level 0 assigns nothing. */
typedef struct uncertainty_patch {
    const char *name;
    const ff_node *place;     /* NULL for the unchanged file */
    const char **assignments; /* for each path of the study; NULL if the file's value stays */
    double cost; /* cost of a case, relative to one with the file's model; NaN: the pilot measures
                  * it */
} uncertainty_patch;

/* "film.h_min_lowest < 0.1 um" */
typedef struct uncertainty_condition {
    const char *text;
    const ff_node *place;
    size_t output;
    bool above;
    const char *limit;
} uncertainty_condition;

typedef struct study_uncertainty {
    study_context *context;
    variates inputs;
    size_t samples;
    size_t sensitivity; /* least number of samples of the last level of the plan */
    size_t pilot;       /* number of pilot samples; 0 without a ladder */
    uint64_t seed;
    estimate_aim aim;
    double shares[UNCERTAINTY_MOST_SHARES]; /* shares of the percentiles */
    size_t share_count;
    uncertainty_condition *conditions;
    size_t condition_count;
    uncertainty_patch levels[ESTIMATE_MOST_LEVELS], models[UNCERTAINTY_MOST_MODELS];
    size_t level_count, model_count;
    size_t first_patch; /* index of the first path that is not an input */

    /* Numbers of cases: the nominal case, the nominal case with its error bar (measured), and the
     * first of the nominal cases with other models, of the pilot samples, and of the further
     * samples. */
    size_t nominal, measured, first_model, first_pilot, first_main;
    estimate_plan plan;
    estimate_input shapes[VARIATE_MOST];
    double *numbers;                      /* standard normal numbers from which the samples are
                                             made */
    double cost[ESTIMATE_MOST_LEVELS];    /* costs relative to a case of level 0 */
    double seconds[ESTIMATE_MOST_LEVELS]; /* CPU time of a case in the pilot, s, or NaN */
} study_uncertainty;

/* uncertainty-read.c: reads the keys and submits the first cases. Returns NULL after an error. */
void *study_uncertainty_read(study_context *context, const study_key_value *values);

/* uncertainty-case.c */
/* Submits one case: with inputs from the numbers of variates_draw, or with the medians if they are
 * NULL. */
size_t study_uncertainty_submit(const study_uncertainty *u, const char *label,
                                const double *numbers, const uncertainty_patch *patch,
                                bool measured);
/* Numbers of cases; `slot` is a level of the plan. */
size_t study_uncertainty_pilot_case(const study_uncertainty *u, size_t level, size_t sample);
size_t study_uncertainty_sample_case(const study_uncertainty *u, size_t slot, size_t sample);
/* Value of an output in a case; NaN if the case failed. */
double study_uncertainty_value(const study_uncertainty *u, size_t number, size_t output);

/* uncertainty-result.c: returns the whole result. */
json_t *study_uncertainty_result(const study_uncertainty *u);

/* uncertainty-words.c: lists the words of an input; 0 if it has more than this number. */
enum { UNCERTAINTY_MOST_WORDS = 8 };
size_t study_uncertainty_words(const variate *v, const char *words[UNCERTAINTY_MOST_WORDS]);
/* Sets u->shapes: how each input follows from its standard normal number. */
void study_uncertainty_shapes(study_uncertainty *u);
/* Sets *own to the samples in which the input has that word. If too few are left at some level,
 * *own has only level 0. Returns the number of these samples that ran the file's model, or 0 if
 * they are too few for a mean with its spread. */
size_t study_uncertainty_of_word(const study_uncertainty *u, const estimate_samples *all,
                                 size_t input, const char *word, estimate_samples *own);

/* uncertainty-limits.c: returns what limits an output: {value, numerical, models, input, sentence};
   `of` is its result, with the shares of the inputs if they are known. */
json_t *study_uncertainty_limits(const study_uncertainty *u, size_t output, const json_t *of);

/* Returns the unit for showing an output, chosen by the size of its mean. */
study_readable study_uncertainty_unit(const char *name, const json_t *of);

/* uncertainty-table.c: writes the findings of the study. */
void study_uncertainty_reduce(void *study, study_answer *answer);

#endif
