/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the result files of a run or a study. */
#ifndef RESULTS_WRITE_H
#define RESULTS_WRITE_H

#include "../accuracy/accuracy.h"
#include "../limits/limits.h"
#include "../study/kinds/kinds.h"
#include "folder.h"
#include "previous-results.h"

#include <jansson.h>

typedef struct results_outcome {
    const ff_pipeline *pipeline;
    const ff_report *report;
    const results_input *input;
    const accuracy_record *errors; /* the measured errors */
    const limits_verdict *limits;
    const char *status; /* "ok", "failed", "stopped", "error" */
    int exit_code;
    json_t *log; /* messages of the models: [{stage, level, text}] */
} results_outcome;

/* A requested output that was computed. */
typedef struct results_requested {
    const ff_stage *stage;
    size_t output;
    char *name; /* "film.h_min", owned */
} results_requested;

/* Returns the requested outputs in the order of the file, to be freed by results_free_requested. */
results_requested *results_list_requested(const ff_pipeline *pipeline, size_t *count);
void results_free_requested(results_requested *list, size_t count);

/* Returns the series against which the requested arrays are plotted; NULL-ended, to be freed. */
const ff_result **results_axes(const ff_pipeline *pipeline);
/* Whether the numbers of a result are written: it is requested, or it is one of the axes. */
bool results_is_kept(const ff_result *result, const ff_result *const *axes);
/* Writes <stage>.<output>.npy for each requested array and for the series against which it is
 * plotted, and <stage>.<output>_error_bar.npy with the error bars of a series. */
void results_write_arrays(const results_outcome *outcome, results_folder *folder);

/* Arrays with more numbers than this are not written as text. */
enum { RESULTS_LONGEST_TEXT = 10000 };

/* Where the arrays of an answer are. For an array in a file, the answer has the name, shape, dims
 * and unit. */
typedef enum {
    RESULTS_IN_FILES,    /* each array has its own file */
    RESULTS_LONG_ABSENT, /* arrays too long for text are left out, also from files */
    RESULTS_LONG_IN_FILES,
    RESULTS_ALL_HERE /* no array is in a file */
} results_arrays;

/* Writes result.json and the arrays of a run to the directory. Sets `removed` to the names of files
 * derived from earlier results, which are removed with them; to be freed. Returns false with an
 * error in the folder's report. */
bool results_write_run(const results_outcome *outcome, const char *directory,
                       results_folder *folder, char **removed);
/* Writes result.json, one JSON object: the requested outputs, the model and parameters of each
 * stage, other computed scalars, and the file names of arrays. */
void results_write_run_json(const results_outcome *outcome, FILE *stream);
/* Writes the answer of --json, one JSON object with the requested outputs. `directory` contains the
 * results, or is NULL. */
void results_write_answer(const results_outcome *outcome, const char *directory, bool all_arrays,
                          FILE *stream);
/* Returns for each dimension of an output the series against which it is plotted:
 * "gears.roll_angle", or "". */
json_t *results_against(const ff_pipeline *pipeline, const ff_stage *stage, size_t output);

/* Returns how a stage ended, in a word or two. */
const char *results_status_name(const ff_stage *stage);

/* The parts of a study for study.json. */
typedef struct results_study {
    const results_input *input; /* has the pipeline of the first case */
    ff_engine *engine;
} results_study;

/* Writes one JSON object with the axes of a study, the stages of its first case and, unless the
 * tally is NULL, the counts of good and doubtful cases. */
void results_write_study_json(const results_study *of, const study_definition *study,
                              const study_tally *tally, FILE *out);

#endif
