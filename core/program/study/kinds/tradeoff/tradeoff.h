/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A trade-off runs finer and finer levels of a reference, then each candidate several times. */
#ifndef STUDY_TRADEOFF_H
#define STUDY_TRADEOFF_H

#include "../answer/kind.h"
#include "../answer/text.h"
#include "front.h"

#include "../../../accuracy/compare.h"

enum { STUDY_MOST_KNOBS = 64 };

/* A level or a candidate: its assignment to each knob; NULL keeps the file's value. */
typedef struct study_point {
    const char **assignments, **values;
    const char *name; /* as the file gives it, or NULL */
    bool alone;       /* no other point has that name */
    const char *label;
    const ff_node *place;
} study_point;

enum {
    TRADEOFF_OUTPUTS,
    TRADEOFF_REFERENCE,
    TRADEOFF_CANDIDATES,
    TRADEOFF_REPEATS,
    TRADEOFF_ACCURACY,
    TRADEOFF_COUNTS,
    TRADEOFF_ALONG,
    TRADEOFF_STAGES,
    STUDY_TRADEOFF_KEYS
};

typedef struct study_tradeoff {
    study_context *context;
    size_t repeats;
    double accuracy;     /* the smallest relative error of interest */
    const char **counts; /* "film.steps": results or quality lines that count work */
    size_t count_count;
    const char *knobs[STUDY_MOST_KNOBS]; /* the assigned paths, or names of choices of files */
    size_t knob_count;
    study_point *points; /* the levels, then the candidates */
    size_t count, levels, candidates;
    size_t ran;   /* number of levels that ran */
    bool stalled; /* refinement no longer reduced the change of the reference */
} study_tradeoff;

/* tradeoff-read.c: reads the keys and submits all cases; NULL after an error. */
void *study_tradeoff_read(study_context *context, const study_key_value *values);

/* Returns the number of a case of a point. Levels run once, candidates `repeats` times. */
size_t study_tradeoff_case(const study_tradeoff *t, size_t point, size_t repeat);
/* Returns the result of the first case of a point. */
const study_outcome *study_tradeoff_outcome(const study_tradeoff *t, size_t point);

/* tradeoff-result.c: computes the difference of two points in an output. Returns false if they
 * cannot be compared. */
bool study_tradeoff_compare(const study_tradeoff *t, size_t a, size_t b, size_t output,
                            accuracy_difference *d);
/* True if the output changed by at most a tenth of the smallest error of interest from the previous
 * level. If it is 0, it must have been 0 there. */
bool study_tradeoff_has_settled(const study_tradeoff *t, size_t level, size_t output);
/* Returns the whole result; `levels` is the number of levels that ran. */
json_t *study_tradeoff_result(const study_tradeoff *t, size_t levels);

/* tradeoff-table.c: writes tables and sentences from the value of the answer. */
void study_tradeoff_print(study_answer *answer);

#endif
