/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a result directory holds of an earlier run, before another one replaces it: results of the
 * same file may be replaced, and the run says what it replaced; those of another file stay unless
 * the user wants them replaced.
 */
#ifndef RESULTS_EARLIER_H
#define RESULTS_EARLIER_H

#include <flankfilm/engine.h>

/* The inputs of a run or a study. */
typedef struct results_input {
    const char *file; /* as the user named it */
    const char *const *sets;
    size_t set_count;
    const ff_pipeline *pipeline; /* of a study: of its file, or of its first case */
    uint64_t key;                /* of what the results depend on */
    const char *accuracy;        /* that is asked for: "2 %"; "": none */
    bool replace;                /* whether results of another file may be replaced */
} results_input;

/* The key of a pipeline that has been built and has not run, and of the accuracy. */
uint64_t results_input_key(const ff_pipeline *pipeline, const char *accuracy);

/* False, with an error, when the directory holds results of another file. `replaced` becomes what
   the run will replace: NULL when there is nothing, "" for results of the same inputs, else how
   these differ; to be freed. */
bool results_earlier_check(const char *directory, const results_input *input, char **replaced,
                           ff_report *report);
/* The same of a study, in which `replaced` is NULL where its stages have not changed. */
bool results_earlier_check_study(const char *directory, const results_input *input, char **replaced,
                                 ff_report *report);

#endif
