/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A trade-off: levels of a reference, ever finer, then candidates again and again. */
#ifndef STUDY_TRADEOFF_H
#define STUDY_TRADEOFF_H

#include "compare.h"
#include "front.h"
#include "text.h"

enum { STUDY_MOST_KNOBS = 64 };

/* A level or a candidate: what it assigns along each knob; NULL: as the file stands. */
typedef struct study_point {
    const char **assignments, **values;
    const char *label;
    const fe_node *place;
} study_point;

enum {
    TRADEOFF_OUTPUTS,
    TRADEOFF_REFERENCE,
    TRADEOFF_CANDIDATES,
    TRADEOFF_REPEATS,
    TRADEOFF_ACCURACY,
    TRADEOFF_ESTIMATES,
    TRADEOFF_COUNTS,
    TRADEOFF_ALONG,
    TRADEOFF_STAGES,
    TRADEOFF_JUDGE,
    STUDY_TRADEOFF_KEYS
};
extern const ff_param study_tradeoff_keys[STUDY_TRADEOFF_KEYS];

typedef struct study_tradeoff {
    study_context *context;
    size_t repeats;
    double accuracy;                  /* the smallest error sought */
    bool rms;                         /* errors of series go by their rms */
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

/* tradeoff-read.c: reads the keys and submits all cases; NULL after an error. */
study_tradeoff *study_tradeoff_read(study_context *context, const study_key_value *values);
/* tradeoff.c: runs them. False: the study cannot go on. */
bool study_tradeoff_run(study_tradeoff *t);

/* The case of a point: levels run once, candidates `repeats` times. */
size_t study_tradeoff_case(const study_tradeoff *t, size_t point, size_t repeat);
/* What the first case of a point gave. */
const study_outcome *study_tradeoff_outcome(const study_tradeoff *t, size_t point);

/* tradeoff-claim.c: what is asked for beside the outputs; the relative error that a case claims of
   an output, and a count of its work, NaN without. */
void study_tradeoff_extras(const study_tradeoff *t);
double study_tradeoff_claim(const study_tradeoff *t, const study_outcome *answer, size_t output);
double study_tradeoff_count(const study_tradeoff *t, const study_outcome *answer, size_t count);

/* tradeoff-result.c: how far two points are apart in an output. False: they cannot be compared. */
bool study_tradeoff_compare(const study_tradeoff *t, size_t a, size_t b, size_t output,
                            study_difference *d);
/* All that came of it; `levels` of the reference ran. */
json_t *study_tradeoff_result(const study_tradeoff *t, size_t levels);

/* tradeoff-print.c, tradeoff-figure.c */
void study_tradeoff_print(study_context *context, const json_t *result);
void study_tradeoff_table(const json_t *result, FILE *out);
void study_tradeoff_draw(const json_t *result, FILE *out);

#endif
