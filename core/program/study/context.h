/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A study whose later cases depend on what earlier ones gave: what tradeoff.c and stability.c
 * share. A driver reads its keys, submits the cases that are known beforehand, and later runs them,
 * looks at what they gave and submits others. A study that was broken off starts anew and submits
 * the same: it goes on.
 */
#ifndef STUDY_CONTEXT_H
#define STUDY_CONTEXT_H

#include "journal.h"

#include <flankfilm/plugin.h>

/* Type of a driver's key whose value, list or map the driver reads itself. */
enum { STUDY_TREE = 0 };

/* What stands under a key of a driver. */
typedef struct study_key_value {
    const fe_node *node; /* NULL: it is not there */
    ff_value value;      /* of a key that has a type: in SI, or its preset */
} study_key_value;

/* What a case assigns to a path: "film.cells=512", called "512"; "" and "": as the file stands. */
typedef struct study_setting {
    const char *assignment, *name;
} study_setting;

typedef struct study_output {
    const double *values; /* NULL: the case lacks it */
    size_t rank, count;   /* 0 and 1: a scalar */
    const double *at;     /* what it is plotted against, not falling; NULL: its index */
    const char *along;    /* the name of that, or "" */
} study_output;

/* A line of quality. */
typedef struct study_quality {
    const char *name; /* "film.load_balance" */
    double value, limit;
    int verdict;      /* FF_GOOD ... */
    const char *text; /* or "" */
} study_quality;

/* What a case gave. Numbers are SI, NaN where there is none. */
typedef struct study_outcome {
    const char *key;       /* that names it in the journal */
    const char *status;    /* "ok", "failed", "invalid", "crashed" ...; "not run" */
    const char *reason;    /* of one that is not ok */
    study_output *outputs; /* one for each of the context, then for each extra */
    study_quality *quality;
    size_t quality_count;
    double work;   /* s of the processor, of the stages in which cases differ */
    double shared; /* s of the others */
} study_outcome;

typedef struct study_submitted {
    const char *label;            /* for messages: "cells 512" */
    fe_place place;               /* where it stands in the file */
    const study_outcome *outcome; /* NULL: nobody has looked yet */
} study_submitted;

/* A file beside the table, "map.csv". */
typedef struct study_result_file {
    const char *name;
    char *text;
    size_t length;
} study_result_file;

enum { STUDY_RESULT_FILES = 4, STUDY_MOST_SUBMITTED = 1000000 };

typedef struct study_context {
    const char *name;  /* the key under `study:` */
    fe_report *report; /* of the call under way */
    fe_arena arena;    /* what lives as long as the study */

    /* What the driver says before anything has run. */
    bool measured;       /* costs count: cases run alone, one after the other, on one core, what
                            differs between them is computed each time, and all of them must be
                            right before any is run; else outputs are scalars */
    const char *further; /* which cases may follow: "then halvings"; "": none */
    const char *const *paths; /* columns of table.csv */
    size_t path_count;
    const study_definition *grid;  /* the first cases are these; NULL: a list */
    const fe_node *const *outputs; /* in place of the file's: "film.h_min" */
    size_t output_count;
    const char *const *extras; /* other results of those stages, where they have them */
    size_t extra_count;
    const char *const *names; /* "film.residual": their stages must be there */
    size_t name_count;
    const char *const *knobs; /* parameters that are scaled; NULL: none */
    size_t knob_count;
    const char *along;         /* of a measured study, see study_measure */
    const char *const *stages; /* whose work counts although cases do not differ there */
    size_t stage_count;

    study_definition list; /* the submitted cases, one axis that grows */
    size_t room;           /* for cases in its columns, and in these: */
    size_t *repeats;
    study_submitted *cases;
    char (*keys)[STUDY_KEY_SIZE]; /* of each case; "": it has not run */
    study_measure *measure;       /* or NULL */
    size_t planned;               /* cases that were submitted before the run */
    study_definition **expanded;
    size_t expanded_count;

    const study_run *run; /* of the run; NULL: nothing may run yet */
    study_counters *counters;
    json_t *records;
    json_t *facts; /* members for `run --json`, or NULL */
    study_result_file files[STUDY_RESULT_FILES];
    size_t file_count;
    int verdict; /* FF_BAD: the study has found what must not be; -1: as good as its cases */
} study_context;

/* context.c */
void study_context_free(study_context *context);
char *study_context_print(study_context *context, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* An error at a node of the file, or NULL; false. */
bool study_context_refuse(study_context *context, const fe_node *where, const char *hint,
                          const char *text);
/* The cases of a map from paths to ranges, lists or single values, as under `sweep:`; NULL after an
   error. They live as long as the context. */
const study_definition *study_context_expand(study_context *context, const fe_node *map);
/* The text of a value; NULL: it is a list, a map, or not there. */
const char *study_word(const fe_node *node);
bool study_is_map(const fe_node *node);
/* A line on the terminal: it is cut where it is too long (indent 0), goes on on lines that begin
   `indent` columns in, or stays as it is (-1). */
void study_context_say(const study_context *context, int indent, const char *line);
/* A file of the study, to be filled in and closed. */
FILE *study_context_file(study_context *context, const char *name);

/* submit.c: adds a case and returns its number 0, 1, ...; settings: one for each path of the
   context, whose texts live as long as it; cases that differ in `repeat` alone are run each for
   itself. */
size_t study_submit(study_context *context, const study_setting *settings, size_t repeat,
                    const char *label, const fe_node *place);
/* Runs the cases from number `begin` to before `end`. False: the study cannot go on. */
bool study_run_submitted(study_context *context, size_t begin, size_t end);
/* The table of the cases that ran and, where they are no grid, what the study is. */
bool study_write_submitted(study_context *context);

/* outcome.c: what a case gave. */
const study_outcome *study_outcome_of(study_context *context, size_t number);

/* scale.c: the stage of "stage.name", or NULL; in *param the number of its parameter in use that is
   named there and holds a number, or SIZE_MAX. */
const fe_stage *study_find_number(const fe_pipeline *pipeline, const char *path, size_t *param);
/* The values of parameters in a case, times factors, as a user would write them; NULL where its
   stage does not run there, or has no such number. */
void study_scale_parameters(study_context *context, size_t number, const char *const *paths,
                            const double *factors, size_t count, const char **scaled);

#endif
