/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The audit of a study whose models are chosen by the program: some of its cases are computed once
 * more, one level finer, to see whether what was promised of their error holds.
 */
#ifndef FF_AUDIT_H
#define FF_AUDIT_H

#include "study.h"

/* A parameter that is not known exactly, by its standard uncertainty. */
typedef struct ff_unsure {
    const char *path; /* "stage.parameter" */
    const char *text; /* as written */
    ff_place place;
    double relative; /* 0: `text` is a quantity */
} ff_unsure;

typedef struct ff_audit {
    size_t every; /* one case in so many */
    uint64_t seed;
    const char **outputs; /* "stage.output"; those that the file names when there are none */
    size_t output_count;
    ff_unsure *inputs;
    size_t input_count;
    ff_place place;
} ff_audit;

/* Fills in what stands under `audit:`. */
bool ff_audit_read(ff_study *study, const ff_node *node, ff_report *report);

/* Whether the pipeline, the first case's, has what the audit names. */
void ff_audit_check(const ff_study *study, const ff_pipeline *pipeline, ff_report *report);

/* The parameter at "stage.name" of a stage that runs, when it is a number; SIZE_MAX: it is not. */
size_t ff_unsure_param(const ff_pipeline *pipeline, const char *path, const ff_stage **stage);
/* Its uncertainty, in SI. False with a sentence in why. */
bool ff_unsure_width(const ff_unsure *unsure, const ff_stage *stage, size_t param, double *width,
                     char *why, size_t why_size);

/* What was chosen: a number in each of equal parts of the study, drawn by the seed. */
size_t ff_audit_count(const ff_audit *audit, const ff_study *study);
size_t ff_audit_case(const ff_audit *audit, const ff_study *study, size_t i);

/*
 * Runs what is not done yet of the audit of a study that has run. *result, to be freed: what it
 * came to; NULL when it was not finished.
 */
bool ff_audit_run(const ff_campaign *campaign, ff_tally *tally, struct json_t **result,
                  ff_report *report);

#endif
