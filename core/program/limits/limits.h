/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a file asks of its answers, `limits: {scuffing.safety: "> 1.5"}`, and how they stand to it.
 * The key asks for the output, too. A list holds several limits of one output. Each number of a
 * series has to keep the limit.
 */
#ifndef LIMITS_H
#define LIMITS_H

#include "../accuracy/measure.h"

#include <jansson.h>

/* The worst last. */
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
    double value; /* the number that is nearest to the limit, or farthest beyond; NaN: not known */
    double bar;   /* its error, in the same SI unit; NaN: nothing tells it; infinite: the value is
                     known from below alone */
} limits_row;

typedef struct limits_verdict {
    limits_row *rows; /* in the order of the file */
    size_t count;
    limits_standing worst;
} limits_verdict;

/* Reports what cannot be read in the limits of the file; false then. */
bool limits_check(ff_run *run);
/* What is asked of the outputs, in SI: who asks the same gets the same text, which is to be freed.
 */
char *limits_print_key(const ff_run *run);
/* Judges what the pipeline has computed. An output without numbers misses its limit; a limit that
   limits_check refuses, or whose output the pipeline does not know, has no row. */
limits_verdict limits_judge(const ff_run *run, const ff_pipeline *pipeline,
                            const accuracy_record *errors);
void limits_free(limits_verdict *verdict);

const char *limits_word(limits_standing standing); /* "met", "met within its bar", "missed" */
/* The word's standing; LIMITS_MISSED for others. */
limits_standing limits_standing_of(const char *word);
/* [{output, asked, standing, value, bar, at_least, unit}]; null for a number that is not known. */
json_t *limits_json(const limits_verdict *verdict);
limits_standing limits_worst(const json_t *list);
/* The same in a word, and the names where it is not "met": "missed: scuffing.safety > 1.5"; to be
   freed. "" without limits. */
char *limits_text(const json_t *list);
/* "of 3 limits 1 missed, 2 met", to be freed; "" without limits. */
char *limits_sentence(const limits_verdict *verdict);

#endif
