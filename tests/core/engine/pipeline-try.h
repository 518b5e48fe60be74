/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pipelines of the toy models from a text, for tests of the core. */
#ifndef PIPELINE_TRY_H
#define PIPELINE_TRY_H

#include "../../../core/engine/pipeline/pipeline.h"

#include <check.h>

/* A line "format: 2" is put before the text, so that the text's first line is line 2. */
typedef struct attempt {
    fe_tree *tree;
    ff_engine *engine;
    ff_report *report;
    ff_pipeline *pipeline; /* may be NULL */
} attempt;

attempt try_build(const char *text, bool everything);
/* With one --set assignment after the text. */
attempt try_build_set(const char *text, const char *assignment, bool everything);
/* Builds as `run` does and runs. */
attempt try_run(const char *text);
void try_close(attempt *a);

/* With these directories of plugins before all others. */
ff_engine *try_engine(const char *const *directories, size_t count);

/* The directory of the fixtures' kinds. */
const char *try_plugins(void);

const ff_stage *try_stage(const attempt *a, const char *name);
const ff_bound *try_param(const attempt *a, const char *of, const char *param);
const ff_result *try_result(const attempt *a, const char *of, const char *output);
double try_scalar(const attempt *a, const char *of, const char *output); /* NaN: none */

/* Some message of that severity holds the phrase; line 0 is any place. */
bool try_says(const attempt *a, ff_severity severity, unsigned line, unsigned column,
              const char *phrase);
void try_print(const attempt *a); /* all messages, to stdout */

/* Checks that say what they found when they fail. */
void check_good(const char *what, const attempt *a);
void check_error(const char *what, const attempt *a, unsigned line, unsigned column,
                 const char *phrase);

/* What a child process left. */
typedef struct remains {
    int exit_code; /* -1: a signal ended it */
    int signal;
    char out[4096], err[4096];
} remains;

/* Runs work(argument) in a child, which exits with its answer. */
remains try_child(int (*work)(const char *argument), const char *argument);

#endif
