/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A load spectrum: the rows of a study last for a time each, and what they give is summed over it.
 * The column "time" of a table, or the key of a listed row, has shares such as 12 %, whose sum is
 * 100 % but for their rounding, or times such as 300 h. A class of no time is no row.
 */
#ifndef STUDY_SPECTRUM_H
#define STUDY_SPECTRUM_H

#include "study.h"

#include "../store/records.h"

extern const char study_time_name[]; /* "time" */

/* What `below` asks: for how long a scalar is below a limit. */
typedef struct study_limit {
    const char *output, *text;
    ff_place place, at; /* of the name and of the limit */
} study_limit;

struct study_spectrum {
    double *times;           /* of each row: shares of 1, or s */
    size_t empty;            /* classes of no time, which are no rows */
    double rounding, stated; /* of the shares: what their digits leave open, and their sum */
    size_t count, room;
    bool shares;
    study_limit *below;
    size_t below_count;
};

/* Takes how long the next row lasts, unless that is 0: *empty. False after an error, whose place is
   that of the text. */
bool study_spectrum_add(study_definition *study, const char *text, ff_place place, bool *empty,
                        ff_report *report);
/* Reads `below`, and checks the sum of the shares and makes it 1 when all rows are there. */
bool study_spectrum_finish(study_definition *study, const ff_node *cases, const ff_node *below,
                           ff_report *report);
/* Checks that the pipeline gives what `below` names, in its unit. */
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
