/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A trade-off: levels of a reference, ever finer, then candidates again and again. */
#ifndef FF_TRADEOFF_H
#define FF_TRADEOFF_H

#include "../compare.h"
#include "../result.h"
#include "front.h"

enum { FF_MOST_KNOBS = 64 };

/* A level or a candidate: what it assigns along each knob; NULL: as the file stands. */
typedef struct ff_point {
    const char **assignments, **values;
    const char *label;
    const ff_written *place;
} ff_point;

enum ff_setting_row {
    FF_OUTPUTS,
    FF_REFERENCE,
    FF_CANDIDATES,
    FF_REPEATS,
    FF_ACCURACY,
    FF_ESTIMATES,
    FF_COUNTS,
    FF_ALONG,
    FF_STAGES,
    FF_JUDGE,
    FF_SETTINGS
};

typedef struct ff_tradeoff {
    const ff_host *host;
    ff_study_model service;
    const ff_written *settings[FF_SETTINGS];
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
    const char *knobs[FF_MOST_KNOBS]; /* paths, or names of choices */
    size_t knob_count;
    ff_point *points; /* levels, then candidates */
    size_t count, levels, candidates;
} ff_tradeoff;

/* read.c */
ff_status ff_tradeoff_plan(void *self, const ff_study_desk *desk, ff_study_plan *plan);

/* The case of a point: levels run once, candidates `repeats` times. */
size_t ff_tradeoff_case(const ff_tradeoff *t, size_t point, size_t repeat);
/* What the first case of a point gave. */
const ff_study_answer *ff_tradeoff_answer(const ff_tradeoff *t, size_t point);

/* claim.c: what the plan asks for beside the outputs; the relative error that a case claims of an
   output, and a count of its work, NaN without. */
void ff_tradeoff_extras(const ff_tradeoff *t, ff_study_plan *plan);
double ff_tradeoff_claim(const ff_tradeoff *t, const ff_study_answer *answer, size_t output);
double ff_tradeoff_count(const ff_tradeoff *t, const ff_study_answer *answer, size_t count);

/* result.c: how far two points are apart in an output. False: they cannot be compared. */
bool ff_tradeoff_compare(const ff_tradeoff *t, size_t a, size_t b, size_t output, ff_difference *d);
/* All that came of it; `levels` of the reference ran. */
json_t *ff_tradeoff_result(const ff_tradeoff *t, size_t levels);

/* print.c, figure.c */
void ff_tradeoff_print(const ff_study_desk *desk, const json_t *result);
void ff_tradeoff_table(const json_t *result, FILE *out);
void ff_tradeoff_draw(const json_t *result, FILE *out);

#endif
