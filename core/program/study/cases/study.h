/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study runs many cases of one pipeline. A case is the file with some assignments, like those
 * of --set. The result of a case is one line of a journal in the study's directory. */
#ifndef STUDY_H
#define STUDY_H

#include <flankfilm/engine.h>

#include <jansson.h>

#include "../../memory/memory.h"
#include "../store/journal.h"
#include "../store/records.h"

/* A position in a table. Lines and columns count from 1. */
typedef struct study_place {
    uint32_t line, column, width;
} study_place;

typedef struct study_rows study_rows;
typedef struct study_spectrum study_spectrum;

/* A path, and the values that it has along one axis. */
typedef struct study_varied {
    const char *path; /* path as in --set, or a name for what the axis varies */
    size_t axis;
    /* "path=value in YAML" for each point of the axis; "" assigns nothing */
    const char **assignments;
    const char **names; /* names of the points; NULL if the values are the names */
    /* where the file contains the path; its source is NULL if the path is in no file */
    ff_place place;
    const ff_node *values; /* one for each point; NULL if the program made the values */
    study_place *places;   /* positions of the values, if a table contains the path; otherwise
                              NULL */
} study_varied;

/* What measure.c records for each case in addition to its scalars: series and costs. */
typedef struct study_measure {
    const ff_node *request; /* list of outputs in place of the file's */
    const char *along;      /* name of the series over which others are plotted; NULL: the program
                               chooses one */
    const char **knobs;     /* stages in which cases differ; these, and the stages that they feed,
                               are evaluated in every case */
    size_t knob_count;
    bool all; /* whether every stage is evaluated in every case */
    /* the repeat number of each case, from 0; cases that differ only in this number count as
       different */
    const size_t *repeat;
} study_measure;

typedef struct study_definition {
    study_varied *varied; /* the paths of a zip or a sample share their axis */
    size_t varied_count;
    /* number of points of each axis; the cases are the product, and the last axis varies fastest */
    size_t *points;
    size_t axis_count;
    size_t count;      /* number of cases */
    size_t followed;   /* axis along which each case starts from the state of its neighbour */
    size_t direction;  /* axis of the directions up and down; this and `followed` are axis_count if
                          there is no such axis */
    bool backwards;    /* whether chains run from the last point of `followed` to the first */
    double time_limit; /* time limit of a case, s; 0: no limit */
    double memory_limit;    /* memory limit of a worker, bytes; 0: its share of the machine's
                               memory */
    const ff_node *request; /* list of outputs in place of the file's; NULL: the file's */
    size_t refined_count;   /* number of the last paths, which only twins assign */
    /* other results to record, "stage.name", in the cases that have them and are no twins */
    const char *const *extras;
    size_t extra_count;
    const study_measure *measure; /* NULL if nothing is measured */
    struct study_driver *driver;  /* NULL if all cases are known from the start */
    study_rows *rows;             /* the table that lists the cases, or NULL */
    bool streams; /* whether its rows come from standard input while the study runs; none has
                     arrived yet */
    study_spectrum *spectrum; /* duration of each row; NULL: rows have none */
    memory_arena arena;
} study_definition;

void study_definition_free(study_definition *study);

/* The keys under `study:` that do not name a driver. NULL ends the list. */
extern const char *const study_keys[];

/* Reads a study without a driver. Returns NULL after an error. */
study_definition *study_read(const ff_node *node, ff_report *report);

/* Reports every key that is not in the list, which NULL ends: "WHOSE: WHERE: unknown key ...". Keys
 * that begin with "x-" are allowed. */
bool study_check_keys(const ff_node *map, const char *whose, const char *where,
                      const char *const *known, ff_report *report);
/* Reads time_limit and memory_limit. */
bool study_read_limits(study_definition *study, const ff_node *node, ff_report *report);

/* Reads a map from paths to the values that they have, as under `sweep:`, or to one value. Returns
   NULL after an error. */
study_definition *study_expand(const ff_node *sweep, ff_report *report);

/* Iterates over the models that cases use in a stage. A model may be returned more than once.
   Returns the next one, or NULL after the last. Starts at {0}. */
typedef struct study_use {
    size_t path, point;
} study_use;
const char *study_next_use(const study_definition *study, study_use *at);
/* Returns the assignment of a case for path k: "path=value" or "". */
const char *study_assignment(const study_definition *study, size_t k, size_t index);
/* Return the value, or its name: at a point of a path, or of path k in a case. */
const char *study_varied_value(const study_varied *varied, size_t point);
const char *study_value(const study_definition *study, size_t k, size_t index);
/* Returns by how much the number of a case grows from one point of an axis to the next, and the
 * point of a case on an axis. */
size_t study_stride(const study_definition *study, size_t axis);
size_t study_rank(const study_definition *study, size_t axis, size_t index);

/* Applies a case to the file of a run: first the files that it includes, then `sets`, then its
   values. */
void study_overlay(const study_definition *study, size_t index, const char *const *sets,
                   size_t set_count, ff_run *run);

/* chain.c: the cases form chains along which a state is passed on. Without `follow` every case is a
   chain of its own. */
size_t study_chains(const study_definition *study);
size_t study_chain_length(const study_definition *study);
/* returns a case */
size_t study_chain_case(const study_definition *study, size_t chain, size_t position);

/* Returns a coordinate in [0,1) of a point of the Sobol sequence. Dimensions count from 0. A seed
   other than 0 shifts the sequence. */
enum { STUDY_SOBOL_DIMENSIONS = 16 };
double study_sobol(uint32_t index, uint32_t dimension, uint64_t seed);

/* The cases to run, and how to run them. */
struct study_counters;
typedef struct study_run {
    const study_definition *study;
    const char *file;
    const ff_run *base; /* the file, which is copied for each case; NULL: each case reads it
                           again */
    const char **sets;
    size_t set_count;
    ff_engine *engine;
    const char *directory;
    const ff_pipeline *pipeline; /* pipeline of the file; its plugins are compared with the plugins
                                    of earlier runs; NULL: no comparison */
    size_t jobs;
    ff_instance *executor; /* an instance that provides FF_EXECUTOR_ID; NULL: workers of this
                              process run all cases */
    size_t shard, shards;  /* this run executes shard number `shard`, from 1 to `shards` */
    /* range of chains to run without writing a table; end 0: all chains, and the table */
    size_t begin, end;
    enum study_rerun rerun;
    bool fail_fast;

    const char *input; /* key of the inputs that the file itself gives; each record contains it;
                          may be NULL */

    /* Called with the answer to a row of standard input, after it is in the journal. */
    void (*answer)(void *ctx, size_t index, const json_t *record, bool known);

    study_records **rows; /* receives the contents of the journals at the end; NULL: not needed */
    /* receives the key of each case that ran or had been finished before; NULL: not needed */
    char (*keys)[STUDY_KEY_SIZE];

    /* Returns, for each dimension of an array, the name of the series over which it is plotted, or
       "" for its index. NULL: nothing is recorded. */
    json_t *(*against)(const ff_pipeline *pipeline, const ff_stage *stage, size_t output);
    /* Checks the contents of the locked directory, and removes files derived from it. Returns false
       after an error. NULL: not called. */
    bool (*enter)(void *ctx, ff_report *report);
    /* Describes the study for readers of its directory. `tally` covers all its cases; it is NULL
       until all are finished. */
    const study_definition *described;
    void (*describe)(void *ctx, const study_definition *study, const study_tally *tally, FILE *out);
    void (*print_line)(void *ctx, int indent, const char *line); /* prints a line of a driver */
    /* called about once per second */
    void (*progress)(void *ctx, const struct study_counters *counters);
    void *ctx;
} study_run;

/* Returns whether a result is stored in a log instead of the journal. */
bool study_is_array(const ff_result *result);

/* Returns {path: value} from assignments "path=value". */
json_t *study_settings_record(const char *const *assignments, size_t count);

#endif
