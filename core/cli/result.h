/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The result of a run, for programs (JSON, CSV) and for people. */
#ifndef FF_RESULT_H
#define FF_RESULT_H

#include "folder.h"
#include "json.h"

typedef struct ff_outcome {
    const ff_pipeline *pipeline;
    const ff_report *report;
    const char *file;   /* as the user named it */
    const char *status; /* "ok", "failed", "stopped", "error" */
    int exit_code;
    const json_t *promise; /* what the run was chosen for, or NULL */
    json_t *log;           /* what the models told: [{stage, level, text}] */
} ff_outcome;

/* One JSON object. details: also what each stage was made of, and scalars and series that were
   computed on the way. */
void ff_result_json(const ff_outcome *outcome, bool details, FILE *stream);
/* Its "outputs" alone, which are the same whenever and wherever they are computed. */
void ff_result_arrays(const ff_pipeline *pipeline, FILE *stream);

/*
 * <stage>.csv holds the series along the first dimension of the model's table of outputs,
 * <stage>-<dimension>.csv those along another, <stage>-scalars.csv the scalars, and
 * <stage>-<output>.csv a requested field: a row per first dimension, a column per second one.
 */
void ff_result_csv(const ff_pipeline *pipeline, ff_folder *folder);

/* What a person wants to read, on stdout, at most FF_WIDTH columns wide. */
void ff_result_summary(const ff_outcome *outcome);

/* How a stage ended, in a word or two. */
const char *ff_status_name(const ff_stage *stage);

/*
 * What dimension `dim` of a stage's results, of length `count`, is plotted against: among the
 * stage's own series and then those that it was fed, the one named like the dimension, else the
 * first rising one in the unit `better`, in s or in rad, else its own first rising one. `self` (or
 * NULL) is the series that asks. NULL: there is none, use the index.
 */
const ff_result *ff_result_axis(const ff_pipeline *pipeline, const ff_stage *stage, const char *dim,
                                size_t count, const ff_result *self, const char *better);

/* The stage that a result belongs to. */
const ff_stage *ff_result_stage(const ff_pipeline *pipeline, const ff_result *result);

#endif
