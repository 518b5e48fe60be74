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
    json_t *log; /* what the models told: [{stage, level, text}] */
} ff_outcome;

/* One JSON object. details: also parameters and wires of each stage. */
void ff_result_json(const ff_outcome *outcome, bool details, FILE *stream);

/*
 * <stage>.csv holds the series along the first dimension of the model's table of outputs,
 * <stage>-<dimension>.csv those along another, <stage>-scalars.csv the scalars, and
 * <stage>-<output>.csv a requested field: a row per first dimension, a column per second one.
 */
void ff_result_csv(const ff_outcome *outcome, ff_folder *folder);

/* What a person wants to read, at most 100 columns wide; folder: path, or NULL. */
void ff_result_summary(const ff_outcome *outcome, const char *folder, FILE *stream, bool colour);

#endif
