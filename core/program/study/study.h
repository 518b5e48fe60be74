/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A study runs many cases of one pipeline. A case is the file with some assignments, like those of
 * --set, laid over it. What a case gave is one line of a journal in the study's directory.
 */
#ifndef STUDY_H
#define STUDY_H

#include <flankfilm/engine.h>

#include <jansson.h>
#include <signal.h>

#include "../memory/memory.h"
#include "judgement.h"

/* Where a value stands in a table, whose lines and columns count from 1. */
typedef struct study_place {
    uint32_t line, column, width;
} study_place;

typedef struct study_records study_records;
typedef struct study_rows study_rows;
typedef struct study_spectrum study_spectrum;

/* A path with the values that it takes along one axis. */
typedef struct study_varied {
    const char *path; /* as --set takes it, or a name for what the axis varies */
    size_t axis;
    /* "path=value in YAML" for each point of the axis; "" assigns nothing */
    const char **assignments;
    const char **names;    /* of the points; NULL when their values are their names */
    ff_place place;        /* of the path in its file; its source is NULL when no file has it */
    const ff_node *values; /* one for each point; NULL when the program made the values */
    study_place *places;   /* of the values in the table that has the path; NULL: it is none */
} study_varied;

/* What measure.c records of each case beside its scalars: series, and the cost. */
typedef struct study_measure {
    const ff_node *request; /* list of outputs that replaces the file's */
    const char *along;  /* name of the series that others are plotted against; NULL lets the program
                           find one */
    const char **knobs; /* stages in which cases differ: they and those that they feed are evaluated
                           in every case */
    size_t knob_count;
    bool all; /* every stage is evaluated in every case */
    /* the repeat of each case, from 0: the same inputs with another repeat are another case */
    const size_t *repeat;
} study_measure;

typedef struct study_definition {
    study_varied *varied; /* the paths of a zip or a sample share their axis */
    size_t varied_count;
    /* how many points each axis has; the cases are the product, in which the last axis varies
       fastest */
    size_t *points;
    size_t axis_count;
    size_t count;        /* how many cases there are */
    size_t followed;     /* axis along which each case starts from its neighbour's state */
    size_t direction;    /* axis of up and down; this and `followed` are axis_count when there is no
                            such axis */
    bool backwards;      /* chains run from the last point of `followed` to the first */
    double time_limit;   /* s for a case; 0 means no limit */
    double memory_limit; /* bytes for a worker; 0 means its share of the machine's */
    const ff_node *request; /* list of outputs that replaces the file's; NULL keeps that */
    /* other results to record, "stage.name", in the cases that have them */
    const char *const *extras;
    size_t extra_count;
    const study_measure *measure; /* NULL when nothing is measured */
    struct study_driver *driver;  /* NULL when all cases are known from the start */
    study_rows *rows;             /* the table that lists the cases, or NULL */
    bool streams; /* its rows come from standard input while the study runs; none is there yet */
    study_spectrum *spectrum; /* how long each row lasts; NULL: no row says it */
    bool overlay_first;       /* the pipeline is checked with the first case laid over the file */
    memory_arena arena;
} study_definition;

/* Reads what stands under `study:`. After errors it returns NULL, or a study that must not be run
   but keeps the texts that the messages need. The tree of the root must outlive the study. */
study_definition *study_open(const ff_node *root, ff_report *report);
void study_free(study_definition *study); /* frees its driver, too; accepts NULL */
void study_definition_free(study_definition *study);

/* A kind of study whose later cases depend on what earlier ones gave. */
typedef struct study_driver_row {
    const char *name; /* the key under `study:` */
    const char *verb; /* what it does, for messages: "maps" */
    const char *summary;
    /* what may stand under it; a key without a type takes a value, a list or a map */
    const ff_param *keys;
    size_t key_count;
} study_driver_row;

extern const study_driver_row study_drivers[]; /* ends with a row without a name */

/* The keys under `study:` that do not name a driver; NULL ends the list. */
extern const char *const study_keys[];

/* Reads a study without a driver; NULL after an error. */
study_definition *study_read(const ff_node *node, ff_report *report);

/* Reports every key that is not in the list, which NULL ends; keys that begin with "x-" are
   allowed. */
bool study_check_keys(const ff_node *map, const char *where, const char *const *known,
                      ff_report *report);
/* Reads time_limit and memory_limit. */
bool study_read_limits(study_definition *study, const ff_node *node, ff_report *report);

/* Reads a map from paths to what they take, as under `sweep:`, or to one value. NULL after an
   error. */
study_definition *study_expand(const ff_node *sweep, ff_report *report);

/* Checks that the pipeline has what the driver of the study names. */
void study_check(const study_definition *study, const ff_pipeline *pipeline, ff_report *report);
/* Returns the name of the i-th model that a study compares the file's with, and its case; NULL
   after the last one. */
const char *study_compared(const study_definition *study, size_t i, size_t *index);
/* Walks through the models that cases put into a stage, the same one perhaps more than once: the
   next one; NULL after the last. Begins at {0}. */
typedef struct study_use {
    size_t path, point;
} study_use;
const char *study_next_use(const study_definition *study, study_use *at);
const char *study_cases(const study_definition *study); /* what its cases are called: "cases" */
const char *
study_further(const study_definition *study); /* which cases may follow; "" when none do */

/* Returns what a case assigns to path k: "path=value" or "". */
const char *study_assignment(const study_definition *study, size_t k, size_t index);
/* Return the value, or its name, at a point of a path; that of path k in a case. */
const char *study_varied_value(const study_varied *varied, size_t point);
const char *study_value(const study_definition *study, size_t k, size_t index);
/* Returns the point of a case on an axis. */
size_t study_rank(const study_definition *study, size_t axis, size_t index);

/* Lays a case over a tree: first the files that it includes, then `sets`, then its values. */
void study_overlay(const study_definition *study, size_t index, const char *const *sets,
                   size_t set_count, ff_tree *tree, ff_report *report);

/* chain.c: the cases form chains, along which a state is handed on; without `follow` every case is
   a chain of its own. */
size_t study_chains(const study_definition *study);
size_t study_chain_length(const study_definition *study);
/* returns a case */
size_t study_chain_case(const study_definition *study, size_t chain, size_t position);

/* Returns a coordinate in [0,1) of a point of the Sobol sequence; dimensions count from 0, and a
   seed other than 0 shifts the sequence. */
enum { STUDY_SOBOL_DIMENSIONS = 16 };
double study_sobol(uint32_t index, uint32_t dimension, uint64_t seed);

enum study_rerun { STUDY_RERUN_NONE, STUDY_RERUN_FAILED, STUDY_RERUN_ALL };

/* What reusing kept results of stages has saved. */
typedef struct study_reuse_counts {
    size_t computed, reused; /* numbers of stages */
    double spent, saved; /* s that the computed stages took, and that the reused ones took when they
                            were computed */
} study_reuse_counts;

/* Sums over all cases in the directory; zero when there is no study in it. */
study_reuse_counts study_savings(const char *directory);

typedef struct study_counters {
    bool leads;    /* this process keeps the counters, not another one of the executor */
    size_t total;  /* cases of this shard */
    size_t before; /* cases of those that an earlier run has done */
    size_t done;   /* cases done, including those */
    size_t failed; /* cases of those done that failed */
    double seconds;
    study_reuse_counts savings; /* of the cases done in this run */
    study_tally tally;          /* of the cases done; to be freed by study_tally_free */
} study_counters;

enum {
    STUDY_KEY_SIZE = 20,  /* bytes of the key of a case, with its end */
    STUDY_NAME_SIZE = 64, /* bytes of the name of a journal or a log */
    STUDY_FORMAT = 2      /* of the files of a study, which study.json tells */
};

/* number = si * factor + offset, in the unit; "" for a pure number */
typedef struct study_readable {
    double factor, offset;
    const char *unit;
} study_readable;

/* What to run, and how. */
typedef struct study_run {
    const study_definition *study;
    const char *file;
    const ff_tree *tree; /* the file, of which each case changes a copy; NULL: each reads it anew */
    const char **sets;
    size_t set_count;
    ff_engine *engine;
    const char *directory;
    const ff_pipeline *pipeline; /* of the file, whose plugins are compared with those of earlier
                                    runs; NULL: they are not */
    size_t jobs;
    ff_instance *executor; /* offers FF_EXECUTOR_ID; NULL: workers of this process run all cases */
    size_t shard, shards;  /* this run does shard number `shard`, from 1 to `shards` */
    size_t begin, end; /* the chains to run, after which no table is written; end 0 means all, with
                          the table */
    enum study_rerun rerun;
    bool fail_fast;

    const char *input; /* the key of the file's own inputs, which each record keeps; may be NULL */

    /* Tells what came of a row of standard input, as soon as the journal has it. */
    void (*answer)(void *ctx, size_t index, const json_t *record, bool known);

    study_records **rows;         /* gets what the journals have at the end; NULL: nobody asks */
    char (*keys)[STUDY_KEY_SIZE]; /* filled in with the key of each case that ran or was known; NULL
                                     when the caller does not need them */

    /* Returns the names of what each dimension of an array is plotted against, "" for its index;
       NULL: none is noted. */
    json_t *(*against)(const ff_pipeline *pipeline, const ff_stage *stage, size_t output);
    /* Looks, with the directory locked, at what is there, and removes what was made of it; false
       after an error. NULL: nothing is looked at. */
    bool (*enter)(void *ctx, ff_report *report);
    /* Describes the study for those who read its directory; `tally` is of all its cases, NULL while
       they are not all done. */
    const study_definition *described;
    void (*describe)(void *ctx, const study_definition *study, const study_tally *tally, FILE *out);
    void (*say)(void *ctx, int indent, const char *line); /* prints a line of a driver */
    /* The unit in which an output of that name and size reads well. */
    study_readable (*readable)(const char *name, const char *si_unit, double magnitude);
    void (*progress)(void *ctx, const study_counters *counters); /* about every second */
    void *ctx;
} study_run;

/* What SIGINT and SIGTERM did before. */
typedef struct study_signals {
    struct sigaction interrupt, terminate;
} study_signals;

/* From here on the first of these signals lets the cases at hand finish, also between the rounds of
   a driver, which runs several lots of cases; the second ends at once. */
void study_signals_catch(study_signals *before);
void study_signals_restore(const study_signals *before);

/* Runs what is not done yet, then writes table.csv. Failed cases are only counted; the report gets
   what keeps the study from going on. */
bool study_execute(const study_run *run, study_counters *counters, ff_report *report);

/* Runs a study with a driver, in this process and its workers: the cases that it submits; then it
   writes the table of those that ran and the files of the driver. */
bool study_drive(const study_run *run, study_counters *counters, ff_report *report);
/* What came of a study with a driver: members for `run --json`, or NULL. */
json_t *study_facts(const study_definition *study);
/* Its verdict, FF_GOOD or FF_BAD; -1 when its cases decide. */
int study_verdict(const study_definition *study);
/* Returns the names of its files, "map.csv, map.figure.json, ", to be freed. */
char *study_files(const study_definition *study);

/* What a run would do. */
typedef struct study_plan {
    size_t done, failed, left;
    size_t again;       /* cases of those left that an earlier run has done with other inputs */
    char changed[1000]; /* what differs: lines such as "duty.torque: 250 N m -> 300 N m" */
    double seconds;     /* s that the cases left will take, estimated from those done; negative when
                           unknown */
} study_plan;

void study_preview(const study_run *run, study_plan *plan);

/* Names of files in a study's directory. */
extern const char study_marker[];      /* its presence makes a directory that of a study */
extern const char study_description[]; /* written by study_run.describe */

/* Reads a regular file as JSON. NULL: it is none, and `error` has the text. */
json_t *study_read_json(int directory, const char *name, json_error_t *error);
/* Refuses a directory whose files are of another format; one without a study is good. */
bool study_check_format(const char *directory, ff_report *report);

/* Whether a result goes to a log instead of the journal. */
bool study_is_array(const ff_result *result);

json_t *study_json_real(double value); /* null for a number that is not finite */
/* {path: value} of assignments "path=value". */
json_t *study_settings_record(const char *const *assignments, size_t count);

/* Start of an FNV-1a hash of 64 bits. */
#define STUDY_HASH_START UINT64_C(0xcbf29ce484222325)

/* Makes a directory and those above it; true when it exists already. */
bool study_make_path(const char *path);

#endif
