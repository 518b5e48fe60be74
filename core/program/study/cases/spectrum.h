/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A load spectrum: each row of a study has a duration, over which results are summed. The column
   "time" of a table, or that key of a listed row, contains shares such as 12 %, which must sum to
   100 % within rounding, or times such as 300 h. A row with the duration 0 is ignored. */
#ifndef STUDY_SPECTRUM_H
#define STUDY_SPECTRUM_H

#include "study.h"

#include "../store/records.h"

extern const char study_time_name[]; /* "time" */

/* An entry of `below`: the time during which a scalar is below the limit is requested. */
typedef struct study_limit {
    const char *output, *text;
    ff_place place, at; /* place of the name and of the limit */
} study_limit;

struct study_spectrum {
    double *times;   /* duration of each row: share (1), or s */
    size_t empty;    /* number of rows with the duration 0 */
    double rounding; /* for shares: the rounding error that their digits allow */
    double stated;   /* for shares: their sum as given */
    size_t count, room;
    bool shares;
    study_limit *below;
    size_t below_count;
};

/* Adds the duration of the next row. A duration of 0 sets *empty. Returns false after an error at
   the place of the text. */
bool study_spectrum_add(study_definition *study, const char *text, ff_place place, bool *empty,
                        ff_report *report);
/* Reads `below`. After all rows are read, checks that the shares sum to 1 within rounding, and
   scales them to 1. */
bool study_spectrum_finish(study_definition *study, const ff_node *cases, const ff_node *below,
                           ff_report *report);
/* Checks that the pipeline gives the outputs of `below` in their units. */
void study_spectrum_check(const study_definition *study, const ff_pipeline *pipeline,
                          ff_report *report);

/* Returns the sums over the rows, in SI: {rows, time, unit: "1" or "s", stated: sum of the shares
 * as given, or null, empty: number of rows with the duration 0, refused: {rows, share of the time,
 * row: the first, reason}, missing: share of the time whose rows gave no numbers, refused ones
 * included, outputs: {name: {unit, mean, energy, lowest, lowest_row, highest, highest_row,
 * values}}, below: [{output, limit, unit, share, rows}], stages: {name: {computed, reused}}} A mean
 * is over the time of the rows that have numbers. An output in W has an energy if times are given
 * in s. `values` has a number or null for each row, of at most 1000 rows. A series has the lowest
 * and the highest number of all rows. */
json_t *study_spectrum_sums(const study_run *run, char (*keys)[STUDY_KEY_SIZE], ff_report *report);

#endif
