/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Common part of the drivers. A driver is a kind of study whose later cases depend on the results
   of earlier ones. A driver reads its keys and submits the cases that are known beforehand. Later
   it runs them, reads their results and submits others. An interrupted study continues in the next
   run, which submits the same cases and finds the finished cases in the journal. */
#ifndef STUDY_CONTEXT_H
#define STUDY_CONTEXT_H

#include "run.h"

#include "../store/journal.h"

#include <flankfilm/plugin.h>

/* The type of a key whose value the driver reads itself, such as a list or a map. */
enum { STUDY_TREE = 0 };

/* The value of a driver's key. */
typedef struct study_key_value {
    const ff_node *node; /* NULL if the key is missing */
    ff_value value;      /* in SI, from the node or the preset, if the key has a type */
} study_key_value;

/* What a case assigns to a path: "film.cells=512", with the name "512". Assignment and name are ""
   if the value of the file is kept. */
typedef struct study_setting {
    const char *assignment, *name;
} study_setting;

typedef struct study_output {
    const double *values; /* NULL if the case lacks the output */
    size_t rank, count;   /* 0 and 1 for a scalar */
    /* the series over which it is plotted, which never decreases; NULL: the index */
    const double *at;
    const char *along; /* the name of that series, or "" */
} study_output;

/* A quality line. */
typedef struct study_quality {
    const char *name; /* "film.load_balance" */
    double value, limit;
    int verdict;      /* FF_GOOD, ... */
    const char *text; /* text of the line, or "" */
} study_quality;

/* The result of a case. Numbers are in SI units, and NaN if they are missing. */
typedef struct study_outcome {
    const char *key;       /* its key in the journal */
    const char *status;    /* "ok", "failed", "invalid", "crashed" ...; "not run" */
    const char *reason;    /* reason if the status is not ok, or "" */
    study_output *outputs; /* one for each output of the context, followed by one for each extra */
    study_quality *quality;
    size_t quality_count;
    double work;             /* processor time of the stages in which cases differ, s */
    double shared;           /* wall time of the other stages, s */
    double processor, saved; /* processor time in s: of the whole case, and of its reused stages
                                when they were computed */
} study_outcome;

typedef struct study_submitted {
    const char *label;            /* for messages: "cells 512" */
    ff_place place;               /* place in the file */
    const study_outcome *outcome; /* NULL until study_outcome_of has read it */
} study_submitted;

/* A file that the driver writes, "map.csv". */
typedef struct study_result_file {
    const char *name;
    char *text;
    size_t length;
} study_result_file;

enum { STUDY_RESULT_FILES = 4, STUDY_MOST_SUBMITTED = 1000000 };

typedef struct study_context {
    const char *name;    /* the driver's key under `study:` */
    const ff_node *root; /* root of the file as given */
    ff_report *report;   /* report of the current call */
    memory_arena arena;  /* memory that lives as long as the study */

    /* The driver sets these before anything runs. */
    bool measured; /* whether costs are measured: cases run one by one on one core, and stages in
                      which cases differ are computed in each case; if false, outputs are scalars */
    const char *further; /* text about the cases that may follow, such as "then halvings"; "" if
                            none */
    const char *const *paths; /* paths that cases assign: the columns of table.csv */
    size_t path_count;
    size_t refined_count; /* number of the last paths, which only twins assign */
    /* a study whose cases come first; NULL if the first cases form a plain list */
    const study_definition *grid;
    const ff_node *const *outputs; /* "film.h_min": these replace the file's outputs */
    size_t output_count;
    const char *const *extras; /* other results to record, from the stages that have them */
    size_t extra_count;
    const char *const *names; /* "film.residual": the pipeline must contain the stages of these */
    size_t name_count;
    const char *const *knobs; /* parameters that are scaled; NULL if there are none */
    size_t knob_count;
    const char *along; /* as in study_measure */
    /* stages whose work is counted although cases do not differ in them */
    const char *const *stages;
    size_t stage_count;
    size_t opened;         /* number of the first cases that must be valid before any case is run */
    const char **compared; /* models that the study compares with the file's */
    size_t compared_count;
    size_t first_compared; /* number of the first case with one of these models */

    study_definition list; /* the submitted cases, along one axis that grows */
    size_t room;           /* number of cases for which memory of `list` and the next members is
                              allocated */
    size_t *repeats;
    study_submitted *cases;
    char (*keys)[STUDY_KEY_SIZE]; /* key of each case; "" until it has run */
    study_measure *measure;       /* NULL if nothing is measured */
    size_t planned;               /* number of cases submitted before the run */
    study_definition **expanded;
    size_t expanded_count;

    const study_run *run; /* NULL while nothing may run */
    study_plan *plan;     /* cases are only counted, in this plan; NULL: they run */
    size_t counted;       /* number of cases counted so far */
    study_counters *counters;
    study_records *records;
    json_t *facts; /* members for `run --json`, or NULL */
    study_result_file files[STUDY_RESULT_FILES];
    size_t file_count;
    int verdict; /* FF_BAD if the study has found a silent failure; -1 if the verdicts of its
                    cases decide */
} study_context;

/* context.c */
void study_context_free(study_context *context);
char *study_context_format(study_context *context, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Reports an error at a node of the file, which may be NULL. Returns false. */
bool study_context_refuse(study_context *context, const ff_node *where, const char *hint,
                          const char *text);
/* Returns the cases of a map from paths to ranges, lists or single values, as under `sweep:`.
   Returns NULL after an error. The cases are valid as long as the context. */
const study_definition *study_context_expand(study_context *context, const ff_node *map);
/* Returns the text of a value, or NULL for a list, a map or a missing node. */
const char *study_word(const ff_node *node);
bool study_is_map(const ff_node *node);
/* Prints a line on the terminal. If it is too long, it is cut (indent 0), continued on lines
 * indented by `indent` columns, or left as it is (-1). */
void study_context_print_line(const study_context *context, int indent, const char *line);
/* Opens a file of the study, which the caller writes and closes. */
FILE *study_context_file(study_context *context, const char *name);
/* Writes these files into the directory; false after an error in the report. */
bool study_context_write(const study_context *context, const char *directory);

/* submit.c: adds a case and returns its number 0, 1, ... `settings` has one entry for each path of
   the context; its texts must be valid as long as the context. Cases that differ only in `repeat`
   are all run. */
size_t study_submit(study_context *context, const study_setting *settings, size_t repeat,
                    const char *label, const ff_node *place);
/* Builds a case. Returns false if it has an error; if `reported`, reports the first one. */
bool study_submitted_opens(const study_context *context, size_t number, bool reported);
/* Runs the cases with the numbers from `begin` to `end` - 1, or counts them for a plan. Returns
   false if the study cannot continue. */
bool study_run_submitted(study_context *context, size_t begin, size_t end);
/* Writes the table of the cases that have run, and the description of the study. */
bool study_write_submitted(study_context *context);

/* outcome.c: returns the result of a case. */
const study_outcome *study_outcome_of(study_context *context, size_t number);
/* Returns its quality line of that name, "film.load_balance", or NULL. */
const study_quality *study_line_of(const study_outcome *outcome, const char *name);

/* scale.c: returns the stage of "stage.name", or NULL. Sets *param to the index of the parameter
   with that name, or to SIZE_MAX if it is not in use or is not a number. */
const ff_stage *study_find_number(const ff_pipeline *pipeline, const char *path, size_t *param);
enum study_scaling {
    STUDY_NOTHING_SCALED, /* no parameter is a number of a stage that runs */
    STUDY_SCALED,
    STUDY_BEYOND_LIMITS, /* the limits of one forbid its value, or no value changes */
};
/* Writes assignments of parameters in a case, multiplied by factors, "film.cells=256". NULL for a
 * parameter that is not a number or whose stage does not run in the case. */
enum study_scaling study_scale_parameters(study_context *context, size_t number,
                                          const char *const *paths, const double *factors,
                                          size_t count, const char **scaled);

#endif
