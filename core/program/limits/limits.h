/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The limits that a file sets for its outputs, `limits: {scuffing.safety: "> 1.5"}`, and whether
 * they are met. An output with a limit is computed as if it were requested. A list contains several
 * limits of one output. Every number of a series must meet them.
 */
#ifndef LIMITS_H
#define LIMITS_H

#include "../accuracy/measure.h"

#include <jansson.h>

/* Standings from best to worst. */
typedef enum {
    LIMITS_MET,
    LIMITS_WITHIN, /* met, but by less than the error bar */
    LIMITS_MISSED,
    LIMITS_STANDINGS
} limits_standing;

typedef struct limits_row {
    const ff_stage *stage;
    size_t output;
    char *name;  /* "scuffing.safety", owned */
    char *asked; /* "> 1.5", owned */
    limits_standing standing;
    double value; /* the number closest to the limit, or farthest beyond it; NaN: not known */
    double bar;   /* its error, in the same SI unit; NaN: not known; infinite: only a lower bound
                     of the value is known */
} limits_row;

typedef struct limits_verdict {
    limits_row *rows; /* in the order of the file */
    size_t count;
    limits_standing worst;
} limits_verdict;

/* Reports limits that cannot be read. Returns false if there are any. */
bool limits_check(ff_run *run);
/* Prints the limits in SI units for the key of a case: equal limits give equal texts. To be
   freed. */
char *limits_print_key(const ff_run *run);
/* Judges the outputs that the pipeline has computed. An output without numbers misses its limit.
   There is no row for a limit that limits_check refuses, or whose output is not in the pipeline. */
limits_verdict limits_judge(const ff_run *run, const ff_pipeline *pipeline,
                            const accuracy_record *errors);
void limits_free(limits_verdict *verdict);

/* returns "met", "met within its bar" or "missed" */
const char *limits_word(limits_standing standing);
/* Returns the standing that the word names; LIMITS_MISSED for any other text. */
limits_standing limits_standing_of(const char *word);
/* Returns [{output, asked, standing, value, bar, at_least, unit}]; null for a number that is not
   known. */
json_t *limits_json(const limits_verdict *verdict);
limits_standing limits_worst(const json_t *list);
/* Returns the overall standing as a word, and the limits that are not "met": "missed:
   scuffing.safety > 1.5"; "" without limits. To be freed. */
char *limits_text(const json_t *list);
/* Returns "of 3 limits 1 missed, 2 met", or "" without limits. To be freed. */
char *limits_sentence(const limits_verdict *verdict);

#endif
