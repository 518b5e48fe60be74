/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes what a run or a study leaves in its directory. */
#ifndef RESULTS_WRITE_H
#define RESULTS_WRITE_H

#include "../accuracy/accuracy.h"
#include "../limits/limits.h"
#include "../study/kinds/kinds.h"
#include "earlier.h"
#include "folder.h"

#include <jansson.h>

typedef struct results_outcome {
    const ff_pipeline *pipeline;
    const ff_report *report;
    const results_input *input;
    const accuracy_record *errors; /* those that were measured */
    const limits_verdict *limits;
    const char *status; /* "ok", "failed", "stopped", "error" */
    int exit_code;
    json_t *log; /* messages of the models: [{stage, level, text}] */
} results_outcome;

/* An output that the file asks for, and that was computed. */
typedef struct results_asked {
    const ff_stage *stage;
    size_t output;
    char *name; /* "film.h_min", owned */
} results_asked;

/* Returns them in the order of the file, to be freed by results_free_asked. */
results_asked *results_list_asked(const ff_pipeline *pipeline, size_t *count);
void results_free_asked(results_asked *list, size_t count);

/* What the arrays that the file asks for are plotted against; NULL-ended, to be freed. */
const ff_result **results_axes(const ff_pipeline *pipeline);
/* Whether the numbers are kept: the file asks for them, or they are one of those. */
bool results_is_kept(const ff_result *result, const ff_result *const *axes);
/* Writes <stage>.<output>.npy of each array that the file asks for, and of what it is plotted
   against; <stage>.<output>_error_bar.npy with the error bars of a series. */
void results_write_arrays(const results_outcome *outcome, results_folder *folder);

/* Arrays of more numbers are not written as text. */
enum { RESULTS_LONGEST_TEXT = 10000 };

/* Where an answer in JSON has arrays: of those in files it says the name, shape, dims and unit. */
typedef enum {
    RESULTS_IN_FILES,    /* all: each has a file of its own */
    RESULTS_LONG_ABSENT, /* those that are too long for text are in no file, either */
    RESULTS_LONG_IN_FILES,
    RESULTS_ALL_HERE /* none */
} results_arrays;

/* Writes the files of a run to the folder in a directory: result.json and the arrays.
   Sets `removed` to the names of what was made of earlier results there and is gone with them, to
   be freed. False with an error in the folder's report. */
bool results_write_run(const results_outcome *outcome, const char *directory,
                       results_folder *folder, char **removed);
/* Writes result.json, one JSON object: what the file asks for, what each stage was made of, and
   scalars that were computed on the way. Of arrays it names the files. */
void results_write_run_json(const results_outcome *outcome, FILE *stream);
/* Writes the answer of a run, one JSON object with what the file asks for. `directory` is where the
   results are, or NULL. */
void results_write_answer(const results_outcome *outcome, const char *directory, bool all_arrays,
                          FILE *stream);
/* Names what each dimension of an output is plotted against: "gears.roll_angle", or "". */
json_t *results_against(const ff_pipeline *pipeline, const ff_stage *stage, size_t output);

/* Says how a stage ended, in a word or two. */
const char *results_status_name(const ff_stage *stage);

/* What a study is made of, for study.json. */
typedef struct results_study {
    const results_input *input; /* its pipeline is that of the first case */
    ff_engine *engine;
} results_study;

/* Writes the axes of a study, the stages of its first case and, unless the tally is NULL, how far
   its cases can be trusted, as one JSON object. */
void results_write_study_json(const results_study *of, const study_definition *study,
                              const study_tally *tally, FILE *out);

#endif
