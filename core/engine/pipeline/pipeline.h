/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A pipeline: the stages of one YAML file, their parameters, their wires, and their results.
 *
 * Evaluation pulls: from the requested outputs back to what they need, each stage once. A stage
 * that no requested output needs is not loaded and not run.
 */
#ifndef FE_PIPELINE_H
#define FE_PIPELINE_H

#include "../plugin/library.h"
#include "../value/tree.h"

/* A parameter of a stage with the value it has. */
typedef struct fe_bound {
    const ff_param *row;
    bool present;   /* given or preset */
    ff_value value; /* SI; points into memory of the stage */
    fe_place place; /* where it was given; source NULL: the model's preset */
    bool proposed;  /* set by the model itself for the requested accuracy */
} fe_bound;

/* A wire of a stage: the stage that feeds the input rows named "wire.*" or "wire". */
typedef struct fe_wire {
    char name[48];
    int stage;      /* index of the feeding stage; -1: not connected */
    bool automatic; /* not written in the file */
    fe_place place;
} fe_wire;

typedef struct fe_result {
    const ff_port *row;
    bool wanted;    /* requested, or needed by another stage */
    bool requested; /* by the file */
    bool required;  /* must be given: requested by name, or for a required input */
    double *data;   /* NULL: not given */
    uint32_t rank;
    size_t shape[FE_MAX_RANK];
    size_t count; /* product of shape; 1 for a scalar */
    /* Dimension i of the data is called fe_result_dim(stage, result, i). */
} fe_result;

typedef struct fe_quality {
    char *name;
    double value, limit;
    int verdict; /* FF_GOOD, FF_DOUBTFUL, FF_BAD */
    char *text;  /* or NULL */
} fe_quality;

/* A model that a stage could use, and what it says of itself. */
typedef struct fe_candidate {
    struct fe_stage *stage; /* with this model in it; its name and place are the stage's */
    bool fits;              /* it can be set up, and gives what is needed */
    bool assessed;          /* the numbers are there */
    int applies;            /* FF_APPLIES ... */
    double error, cost;
    char *reason;    /* the model's own, or what keeps it out */
    char *proposals; /* "cells: 256, steps: auto", or "" */
    double judged;   /* the part of the error that the judge of a law adds; 0: none */
    char *verdict;   /* the reason of that judge; NULL: none */
} fe_candidate;

/* A stage whose model is chosen at run time, for an accuracy. */
typedef struct fe_choice {
    const char *use; /* as written: KIND/auto, or the one model that is tuned */
    double accuracy;
    bool refine; /* settings of the file may change, and the best model is taken whatever its error
                  */
    fe_candidate *candidates;
    size_t count;
    const fe_candidate *chosen; /* NULL: not yet, or none does */
    /* Of laws, which offer services: the stages that they serve judge them against a reference. */
    bool serves;
    const fe_candidate *reference; /* NULL: not known yet, or the candidates serve none */
} fe_choice;

typedef struct fe_stage {
    char *name;
    fe_place place;
    const char *use; /* model id as written */
    fe_place use_place;
    const fe_node *node;
    const fe_loaded *loaded; /* NULL: not loaded */
    bool needed;             /* some requested output needs it */
    char *why;               /* in words, for `explain`: "film.h_min is requested", "feeds film",
                                "no requested output needs it" */
    fe_bound *params;        /* one per row of the model; NULL before bind */
    fe_wire *wires;
    size_t wire_count;
    fe_result *results; /* one per output row */
    bool ran;
    bool reused;      /* its results are those of an earlier run */
    ff_status status; /* of evaluate */
    double seconds;   /* wall time of evaluate, also of the earlier run */
    double work;      /* s: processor time of evaluate, over all threads */
    fe_quality *quality;
    size_t quality_count;
    void *state;       /* in a chain: what evaluate starts from, then what it left; NULL: none */
    size_t state_size; /* bytes of it */
    fe_choice *choice; /* NULL: the file says which model. Until the choice is made, the stage has
                          all that its candidates have, by name; then it is that of the chosen */
    struct fe_instance *instance; /* the live plugin object; private to core/engine/pipeline */
} fe_stage;

typedef struct fe_pipeline {
    char *title; /* or NULL */
    fe_stage *stages;
    size_t count;
    size_t *order; /* indices of stages; each comes after those that feed it */
    bool chained;  /* stages start from `state`, and leave one */
    struct fe_pipeline_memory *memory;
} fe_pipeline;

/* Called while a stage works; a non-zero answer stops the run. */
typedef struct fe_watch {
    int (*progress)(void *ctx, const fe_stage *stage, double fraction);
    void (*log)(void *ctx, const fe_stage *stage, int level, const char *text);
    /* May fill in the results of a stage, which is then not evaluated. May be NULL. */
    bool (*recall)(void *ctx, const fe_pipeline *pipeline, fe_stage *stage);
    /* Called after each evaluation, good or not. May be NULL. */
    void (*keep)(void *ctx, const fe_pipeline *pipeline, const fe_stage *stage);
    void *ctx;
} fe_watch;

/*
 * Reads the file's `format`, `title`, `pipeline` and `outputs`, loads the models that are needed
 * (with `everything` all of them, as `check` wants), binds parameters, wires stages and
 * calls their `ready`. All errors of the file go to the report in one pass. NULL only when nothing
 * can be shown; with errors in the report the pipeline must not be run. The tree and the library
 * outlive the pipeline.
 */
fe_pipeline *fe_pipeline_build(const fe_tree *tree, fe_library *library, bool everything,
                               fe_report *report);

/* Runs what is needed; watch may be NULL. False when a stage failed: the report says why, and the
   results so far stay readable. */
bool fe_pipeline_run(fe_pipeline *pipeline, const fe_watch *watch, fe_report *report);

/* True for KIND/auto, which leaves the model to be chosen. */
bool fe_names_kind_only(const char *use);
/* Makes the choices, and runs the stages that they depend on alone. True without any choice. */
bool fe_pipeline_choose(fe_pipeline *pipeline, const fe_watch *watch, fe_report *report);

/* The stage of "stage.name"; NULL: there is none. *name: what stands behind the dot, or "". */
fe_stage *fe_stage_of(const fe_pipeline *pipeline, const char *path, const char **name);
const char *fe_result_dim(const fe_stage *stage, size_t output, uint32_t axis);
/* The result that feeds input row `input`; NULL: not connected, or a service. */
fe_result *fe_feeding_result(const fe_pipeline *pipeline, const fe_stage *stage, size_t input);
/* Writes the value of a present parameter as a user would: "[50, 50]", "3 mm", "auto". */
void fe_bound_print(const fe_stage *stage, size_t param, char *out, size_t size);
/* Where a value comes from: "pair.yaml:12", "--set", "preset"; "proposed" by the model for the
   accuracy asked for. */
void fe_bound_origin(const fe_bound *bound, char *out, size_t size);
/* True when the stage runs and hands a state to the neighbouring case of a chain. */
bool fe_stage_has_state(const fe_stage *stage);
/* Replaces the state of the stage by a copy. */
void fe_stage_set_state(fe_stage *stage, const void *bytes, size_t size);
const char *fe_verdict_name(int verdict); /* "good", "doubtful", "bad" */

/* Makes room for an output, zeroed: rank and shape are those of its row. */
double *fe_result_fill(fe_result *result, uint32_t rank, const size_t *shape);
void fe_add_quality(fe_stage *stage, const char *name, double value, double limit, int verdict,
                    const char *text);

/* The words that may stand at the top of a file: "format", "title", ...; NULL-terminated. */
extern const char *const fe_pipeline_top_keys[];

void fe_pipeline_free(fe_pipeline *pipeline);

#endif
