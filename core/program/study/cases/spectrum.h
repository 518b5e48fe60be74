/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A load spectrum: each row of a study lasts for a time, over which its results are summed. The
 * column "time" of a table, or the key of a listed row, holds shares such as 12 %, which sum to 100
 * % within rounding, or times such as 300 h. A class of no time is left out.
 */
#ifndef STUDY_SPECTRUM_H
#define STUDY_SPECTRUM_H

#include "study.h"

#include "../store/records.h"

extern const char study_time_name[]; /* "time" */

/* A limit of `below`: asks for how long a scalar is below it. */
typedef struct study_limit {
    const char *output, *text;
    ff_place place, at; /* of the name and of the limit */
} study_limit;

struct study_spectrum {
    double *times;           /* of each row: shares of 1, or s */
    size_t empty;            /* number of classes of no time */
    double rounding, stated; /* of the shares: rounding left open by their digits, and their sum */
    size_t count, room;
    bool shares;
    study_limit *below;
    size_t below_count;
};

/* Takes the duration of the next row. A duration of 0 sets *empty. False after an error at the
   place of the text. */
bool study_spectrum_add(study_definition *study, const char *text, ff_place place, bool *empty,
                        ff_report *report);
/* Reads `below`. Once all rows are there, checks that the shares sum to 1 within rounding and
   scales them to 1. */
bool study_spectrum_finish(study_definition *study, const ff_node *cases, const ff_node *below,
                           ff_report *report);
/* Checks that the pipeline gives the outputs of `below` in their units. */
void study_spectrum_check(const study_definition *study, const ff_pipeline *pipeline,
                          ff_report *report);

/* Returns the sums over the rows, in SI:
     {rows, time, unit: "1" or "s", stated: sum of the shares as they stand, or null,
      empty: classes of no time,
      refused: {rows, share of the time, row: the first, reason},
      missing: share of the time whose rows gave no numbers, with the refused ones,
      outputs: {name: {unit, mean, energy, lowest, lowest_row, highest, highest_row, values}},
      below: [{output, limit, unit, share, rows}],
      stages: {name: {computed, reused}}}
   A mean is over the time of the rows that have numbers. An output in W has an energy where the
   times are times; `values` has a number or null for each of at most 1000 rows. Of a series there
   are the lowest and the highest number of all rows. */
json_t *study_spectrum_sums(const study_run *run, char (*keys)[STUDY_KEY_SIZE], ff_report *report);

#endif
