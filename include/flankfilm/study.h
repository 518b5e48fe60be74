/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.study/1": a study that asks for its cases by what earlier ones gave.
 *
 * A model of the kind "study" that offers it is no stage of a pipeline: a key under `study:` names
 * it, and what stands there are its parameters: `study: {tradeoff: {...}}` uses study/tradeoff. The
 * model says what it wants to know of a case and asks for cases; the program makes them out of the
 * user's file, runs each in a process of its own, writes down what it gave, and takes over what an
 * earlier run has done. A study that was broken off starts anew and asks the same: it goes on.
 *
 *     static ff_status run(void *self, const ff_study_desk *desk)
 *     {
 *         size_t first = desk->ask(desk->ctx, &one), end = desk->ask(desk->ctx, &other) + 1;
 *         ff_status status = desk->run(desk->ctx, first, end);
 *         for (size_t i = first; status == FF_OK && i < end; i++)
 *             ... desk->answer(desk->ctx, i)->outputs[0]->values ...
 *         return status;
 *     }
 */
#ifndef FLANKFILM_STUDY_H
#define FLANKFILM_STUDY_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FF_STUDY_ID "flankfilm.study/1"

/* What a case assigns to a path: "film.cells=512", called "512"; "" and "": as the file stands. */
typedef struct ff_study_point {
    const char *assignment, *name;
} ff_study_point;

typedef struct ff_study_case {
    size_t size;
    const ff_study_point *points; /* one for each path of the plan */
    size_t repeat;                /* cases that differ in it alone are run each for itself */
    const char *label;            /* for messages: "cells 512" */
    const ff_written *place;      /* where it stands in the file; NULL: nowhere */

    /* With FF_STUDY_SWEEPS, in place of points: a case of the sweep once more, from the state that
       it had in its chain. */
    size_t of;               /* its number */
    const char *const *sets; /* laid over it: "film.cells=512" */
    size_t set_count;
    const char *const *outputs; /* in place of its own: "film.h_min" */
    size_t output_count;
} ff_study_case;

/* The cases of a map from paths to values; the last path varies fastest. */
typedef struct ff_study_block {
    size_t size;
    const char *const *paths;
    const size_t *lengths; /* values of each path */
    size_t path_count;
    const ff_study_point *points; /* of each path for the first case, then for the next */
    size_t case_count;
} ff_study_block;

enum {
    FF_STUDY_STRICT = 1,  /* the cases of the plan must be right before any of them is run */
    FF_STUDY_SCALARS = 2, /* the outputs are scalars; else series, too */
    FF_STUDY_COSTS = 4,   /* costs count: cases run alone, one after the other, on one core, and
                             what differs between them is computed each time */
    FF_STUDY_SWEEPS = 8   /* it goes with a sweep, or the one case of a file without: those are the
                             first cases, which have run when `run` begins; the plan is empty */
};

/* What the study is before anything has run. */
typedef struct ff_study_plan {
    size_t size;
    uint32_t flags;
    const char *const *paths; /* columns of table.csv */
    size_t path_count;
    const ff_study_block *grid; /* the cases asked for in `plan` are these; NULL: a list */
    const char *cases;          /* what those are called: "cells of the grid"; "": cases */
    const char *further;        /* which others may follow: "then halvings"; "": none */

    /* In place of the file's: words "film.h_min", that stand in the file or have its `place`. */
    const ff_written *const *outputs;
    size_t output_count;
    const char *const *names; /* "film.residual": their stages must be there */
    size_t name_count;
    const char *const *knobs; /* parameters that are to be turned: the same, and a warning when none
                                 of them is a number there; NULL: it turns none */
    size_t knob_count;

    const char *along;         /* with FF_STUDY_COSTS: the series that others are plotted against;
                                  NULL: any */
    const char *const *extras; /* "film.h_min_error": other results of those stages that run, where
                                  they have them */
    size_t extra_count;
    const char *const
        *stages; /* with FF_STUDY_COSTS: whose work counts although cases do not differ there */
    size_t stage_count;
} ff_study_plan;

typedef struct ff_study_output {
    size_t size;
    const double *values; /* NULL: the case lacks it */
    size_t rank, count;   /* 0 and 1: a scalar */
    const double *at;     /* what it is plotted against, not falling; NULL: its index */
    const char *along;    /* the name of that, or "" */
} ff_study_output;

typedef struct ff_study_line {
    size_t size;
    const char *name; /* "film.load_balance" */
    double value, limit;
    int32_t verdict;  /* FF_GOOD ... */
    const char *text; /* or "" */
} ff_study_line;

/* What a case gave; lives as long as the study. Numbers are SI, NaN where there is none. */
typedef struct ff_study_answer {
    size_t size;
    const char *key;                       /* that names it in the journal */
    const char *status;                    /* "ok", "failed", "invalid", "crashed" ...; "not run" */
    const char *reason;                    /* of one that is not ok */
    const ff_study_output *const *outputs; /* one for each of the plan, then for each extra */
    const ff_study_line *const *lines;     /* of quality */
    size_t line_count;
    double work;   /* s of the processor, of the stages in which cases differ */
    double shared; /* s of the others */

    /* As JSON: {set: {path: value}; outputs: {name: [unit, value]}, of the scalars; chosen: {stage:
       model} and choices: {stage: {use, model, accuracy, promised, settings, doubled}}, of stages
       that have chosen; command: that runs a case again which failed}; NULL: it did not run. */
    const char *record;
} ff_study_answer;

/* A stage of a case before it runs. */
typedef struct ff_study_stage {
    size_t size;
    const char *name;
    const ff_model *model; /* its tables; those of all candidates until one is chosen; NULL: none */
    int32_t runs;          /* an output needs it */
    int32_t chooses;       /* its model or its settings are chosen for an accuracy */
    const uint8_t *numbers; /* of each parameter: it is one real number; NULL: the stage is wrong */
    const uint8_t *wanted;  /* of each output: 1: another stage needs it, 2: it is asked for */
} ff_study_stage;

typedef struct ff_study_look {
    size_t size;
    const char *reason; /* why it cannot run; "": it can */
    const ff_study_stage *const *stages;
    size_t stage_count;
    const char *const *outputs; /* as the file lists them: "film.h_min", "film.*"; in `run` only */
    size_t output_count;
} ff_study_look;

/* What the program offers to a study. What a plan points to and what is handed out lives as long as
   the model's instance; other texts and tables handed over are copied. */
typedef struct ff_study_desk {
    size_t size;
    void *ctx; /* first argument of every function below */

    /* Zeroed; there is always some. */
    void *(*memory)(void *ctx, size_t size);
    /* Says what is wrong at a place of the file, and what to do about it (or NULL); returns status,
       FF_INVALID or FF_NOCONV. */
    ff_status (*refuse)(void *ctx, ff_status status, const ff_written *where, const char *hint,
                        const char *text);
    /* The cases of a map from paths to ranges, lists or single values, as under `sweep:`. NULL: it
       is wrong, which has been said; return FF_INVALID. */
    const ff_study_block *(*expand)(void *ctx, const ff_written *map);
    /* The number of the case: 0, 1, ... Those that `plan` asks for are there when `run` begins. */
    size_t (*ask)(void *ctx, const ff_study_case *c);

    /* In `run` only. Runs the cases from number `begin` to before `end`. Not FF_OK: return that. */
    ff_status (*run)(void *ctx, size_t begin, size_t end);
    const ff_study_answer *(*answer)(void *ctx, size_t number);
    /* The value of a parameter in the case, times a factor, as a user would write it; NULL: its
       stage does not run there, or has no such number. */
    const char *(*turn)(void *ctx, size_t number, const char *path, double factor);

    /* What came of it: a line on the terminal, which is cut where it is too long (indent 0), goes
       on on lines that begin `indent` columns in, or stays as it is (-1); a text file beside the
       table, "map.csv"; members of a JSON object, for `run --json`; and FF_BAD when the study has
       found what must not be. Without a word on that, it is as good as its cases. */
    void (*say)(void *ctx, int32_t indent, const char *line);
    void (*file)(void *ctx, const char *name, const char *text);
    void (*facts)(void *ctx, const char *json);
    void (*conclude)(void *ctx, int32_t verdict);

    /* In `run`, and in `check` of case 0. What the case is; until the next call of a function. */
    const ff_study_look *(*look)(void *ctx, size_t number);
    /* The value of a real parameter that the case has, plus `times` what `by` says, "2 %" of it or
       "5 um", as a user would write it; NULL, with *why. */
    const char *(*shift)(void *ctx, size_t number, const char *path, const char *by, double times,
                         const char **why);
} ff_study_desk;

typedef struct ff_study_model {
    size_t size;
    void *self;
    const char *verb; /* what it does with cases: "maps" */
    /* Reads the parameters and asks for the cases that are known beforehand, also for `check`. */
    ff_status (*plan)(void *self, const ff_study_desk *desk, ff_study_plan *plan);
    /* FF_OK, or a status after refuse or host->fail. */
    ff_status (*run)(void *self, const ff_study_desk *desk);
    /* Whether the file has what the study names, before anything runs; with FF_STUDY_SWEEPS so many
       cases of the sweep. It may change what the plan says of further cases. NULL: all is well. */
    ff_status (*check)(void *self, const ff_study_desk *desk, size_t cases);
} ff_study_model;

#ifdef __cplusplus
}
#endif
#endif
