/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The result of a run, for programs (JSON, CSV) and for people. */
#ifndef CLI_RESULT_H
#define CLI_RESULT_H

#include "folder.h"
#include "json.h"

typedef struct cli_outcome {
    const fe_pipeline *pipeline;
    const fe_report *report;
    const char *file;   /* as the user named it */
    const char *status; /* "ok", "failed", "stopped", "error" */
    int exit_code;
    json_t *log; /* what the models told: [{stage, level, text}] */
} cli_outcome;

/* One JSON object. details: also what each stage was made of, and scalars and series that were
   computed on the way. */
void cli_result_json(const cli_outcome *outcome, bool details, FILE *stream);
/* Its "outputs" alone, which are the same whenever and wherever they are computed. */
void cli_result_arrays(const fe_pipeline *pipeline, FILE *stream);

/*
 * <stage>.csv holds the series along the first dimension of the model's table of outputs,
 * <stage>-<dimension>.csv those along another, <stage>-scalars.csv the scalars, and
 * <stage>-<output>.csv a requested field: a row per first dimension, a column per second one.
 */
void cli_result_csv(const fe_pipeline *pipeline, cli_folder *folder);

/* What a person wants to read, on stdout, at most CLI_WIDTH columns wide. */
void cli_result_summary(const cli_outcome *outcome);

/* How a stage ended, in a word or two. */
const char *cli_status_name(const fe_stage *stage);

/*
 * What dimension `dim` of a stage's results, of length `count`, is plotted against: among the
 * stage's own series and then those that it was fed, the one named like the dimension, else the
 * first rising one in the unit `better`, in s or in rad, else its own first rising one. `self` (or
 * NULL) is the series that asks. NULL: there is none, use the index.
 */
const fe_result *cli_result_axis(const fe_pipeline *pipeline, const fe_stage *stage,
                                 const char *dim, size_t count, const fe_result *self,
                                 const char *better);

/* The stage that a result belongs to. */
const fe_stage *cli_result_stage(const fe_pipeline *pipeline, const fe_result *result);

#endif
