/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks the earlier results in a directory before a run replaces them. Results of the same file
 * may be replaced, and the run prints how their inputs differ. Results of another file are kept
 * unless the user allows to replace them. */
#ifndef RESULTS_PREVIOUS_RESULTS_H
#define RESULTS_PREVIOUS_RESULTS_H

#include <flankfilm/engine.h>

/* The inputs of a run or a study. */
typedef struct results_input {
    const char *file; /* path as the user gave it */
    const char *const *sets;
    size_t set_count;
    /* the pipeline; for a study, the pipeline of its file or of its first case */
    const ff_pipeline *pipeline;
    uint64_t key;         /* hash of everything on which the results depend */
    const char *accuracy; /* the requested accuracy, "2 %"; "" if there is none */
    bool replace;         /* whether results of another file may be replaced */
} results_input;

/* Returns the hash of a built pipeline, before it runs, and of the requested accuracy. */
uint64_t results_input_key(const ff_pipeline *pipeline, const char *accuracy);

/* Returns false, with an error, if the directory contains results of another file. Sets `replaced`
 * to NULL if there is nothing to replace, to "" if the earlier results have the same inputs, and
 * else to a description of how the inputs differ; to be freed. */
bool results_earlier_check(const char *directory, const results_input *input, char **replaced,
                           ff_report *report);
/* results_earlier_check for a study. `replaced` is also NULL if the stages of the study have not
 * changed. */
bool results_earlier_check_study(const char *directory, const results_input *input, char **replaced,
                                 ff_report *report);

#endif
