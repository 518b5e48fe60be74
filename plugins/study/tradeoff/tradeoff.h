/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A trade-off: levels of a reference, ever finer, then candidates again and again. */
#ifndef STUDY_TRADEOFF_H
#define STUDY_TRADEOFF_H

#include "../compare.h"
#include "../result.h"
#include "front.h"

enum { STUDY_MOST_KNOBS = 64 };

/* A level or a candidate: what it assigns along each knob; NULL: as the file stands. */
typedef struct study_point {
    const char **assignments, **values;
    const char *label;
    const ff_written *place;
} study_point;

enum study_setting_row {
    STUDY_OUTPUTS,
    STUDY_REFERENCE,
    STUDY_CANDIDATES,
    STUDY_REPEATS,
    STUDY_ACCURACY,
    STUDY_ESTIMATES,
    STUDY_COUNTS,
    STUDY_ALONG,
    STUDY_STAGES,
    STUDY_JUDGE,
    STUDY_SETTINGS
};

typedef struct study_tradeoff {
    const ff_host *host;
    ff_study_model service;
    const ff_written *settings[STUDY_SETTINGS];
    int64_t repeats;
    double accuracy; /* the smallest error sought */
    bool rms;        /* errors of series go by their rms */
    const char *along;

    const ff_study_desk *desk;
    const ff_study_plan *plan;
    const char *const *const *claims; /* of each output: names of results or lines of quality of its
                                         stage that say its error, NULL behind the last; NULL: those
                                         called OUTPUT_error or OUTPUT_..._error */
    const char **counts;              /* "film.steps": results or lines that count work */
    size_t count_count;
    const char *knobs[STUDY_MOST_KNOBS]; /* paths, or names of choices */
    size_t knob_count;
    study_point *points; /* levels, then candidates */
    size_t count, levels, candidates;
} study_tradeoff;

/* read.c */
ff_status study_tradeoff_plan(void *self, const ff_study_desk *desk, ff_study_plan *plan);

/* The case of a point: levels run once, candidates `repeats` times. */
size_t study_tradeoff_case(const study_tradeoff *t, size_t point, size_t repeat);
/* What the first case of a point gave. */
const ff_study_answer *study_tradeoff_answer(const study_tradeoff *t, size_t point);

/* claim.c: what the plan asks for beside the outputs; the relative error that a case claims of an
   output, and a count of its work, NaN without. */
void study_tradeoff_extras(const study_tradeoff *t, ff_study_plan *plan);
double study_tradeoff_claim(const study_tradeoff *t, const ff_study_answer *answer, size_t output);
double study_tradeoff_count(const study_tradeoff *t, const ff_study_answer *answer, size_t count);

/* result.c: how far two points are apart in an output. False: they cannot be compared. */
bool study_tradeoff_compare(const study_tradeoff *t, size_t a, size_t b, size_t output,
                            study_difference *d);
/* All that came of it; `levels` of the reference ran. */
json_t *study_tradeoff_result(const study_tradeoff *t, size_t levels);

/* print.c, figure.c */
void study_tradeoff_print(const ff_study_desk *desk, const json_t *result);
void study_tradeoff_table(const json_t *result, FILE *out);
void study_tradeoff_draw(const json_t *result, FILE *out);

#endif
