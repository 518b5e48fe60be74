/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A study: many cases of one pipeline. A case is the file with some assignments, like those of
 * --set, laid over it. What a case gave is one line of a journal in the study's directory.
 */
#ifndef STUDY_H
#define STUDY_H

#include "../../engine/pipeline/service.h"
#include "../../engine/value/memory.h"

struct json_t;

/* A path with the values that it takes along one axis. */
typedef struct study_varied {
    const char *path; /* as --set takes it, or the name of what the axis stands for */
    size_t axis;
    const char **assignments; /* "path=value in YAML", one for each point of the axis; "": none */
    const char **names;       /* of the points; NULL: they are called by their values */
    fe_place place;           /* of the path in its file; source NULL: it stands in none */
    const fe_node *values;    /* one for each point; NULL: they are made */
} study_varied;

/* What the cases of a study say beyond their scalars, at which cost: see measure.c. */
typedef struct study_measure {
    const fe_node *request; /* the list of outputs, which takes the place of the file's */
    const char *along;      /* the series that others are plotted against; NULL: one is found */
    const char **knobs;     /* stages in which cases differ: these and those that they feed are
                               evaluated in every case */
    size_t knob_count;
    bool all;             /* every stage is */
    const size_t *repeat; /* of each case, from 0; it is part of what makes a case */
} study_measure;

typedef struct study_definition {
    study_varied *varied; /* those of a zip or a sample share their axis */
    size_t varied_count;
    size_t *points; /* of each axis; the cases are the product, the last axis varies fastest */
    size_t axis_count;
    size_t count;        /* of cases */
    size_t followed;     /* axis along which each case starts from its neighbour's state */
    size_t direction;    /* axis of up and down; this and `followed` are axis_count without one */
    bool backwards;      /* from the last point of `followed` to the first */
    double time_limit;   /* s for a case; 0: none */
    double memory_limit; /* bytes for a worker; 0: its share of the machine's */
    const fe_node *request;    /* the list of outputs in place of the file's; NULL: those */
    const char *const *extras; /* other results, "stage.name", where there are such */
    size_t extra_count;
    const study_measure *measure; /* NULL: nothing is measured */
    struct study_driver *driver;  /* NULL: all cases are known */
    bool overlay_first;           /* the first case shows what holds for all */
    fe_arena arena;
} study_definition;

/* Reads what stands under `study:`. With errors in the report NULL, or a study that must not be
   run: it outlives the printing. The tree of the node outlives the study. */
study_definition *study_open(const fe_node *node, fe_report *report);
void study_free(study_definition *study); /* with its driver; accepts NULL */
void study_definition_free(study_definition *study);

/* What makes a study whose later cases depend on what earlier ones gave. */
typedef struct study_driver_row {
    const char *name; /* the key under `study:` */
    const char *verb; /* what it does with cases */
    const char *summary;
    const ff_param *keys; /* what may stand under it; without a type: a value, a list or a map */
    size_t key_count;
} study_driver_row;

extern const study_driver_row study_drivers[]; /* the last has no name */

/* Words that stand under `study:` beside those that name drivers; NULL behind the last. */
extern const char *const study_keys[];

/* The same where no driver is named. */
study_definition *study_read(const fe_node *node, fe_report *report);

/* Errors for keys that are not in the list, which NULL ends. */
bool study_check_keys(const fe_node *map, const char *where, const char *const *known,
                      fe_report *report);
/* time_limit and memory_limit. */
bool study_read_limits(study_definition *study, const fe_node *node, fe_report *report);

/* Of a map from paths to what they take, as under `sweep:`, or to one value. NULL after an error.
 */
study_definition *study_expand(const fe_node *sweep, fe_report *report);

/* Whether the pipeline, as its file stands, has what the driver of the study names. */
void study_check(const study_definition *study, const fe_pipeline *pipeline, fe_report *report);
const char *study_cases(const study_definition *study);   /* what they are called: "cases" */
const char *study_further(const study_definition *study); /* which may follow; "": none */

/* Path k of a case: what it assigns, as "path=value" or ""; its point; the point's name. */
const char *study_assignment(const study_definition *study, size_t k, size_t index);
const char *study_varied_value(const study_varied *varied, size_t point);
const char *study_value(const study_definition *study, size_t k, size_t index);
size_t study_rank(const study_definition *study, size_t axis, size_t index);

/* Lays a case over a tree: the files that it includes, `sets` over them, and its values on top. */
void study_overlay(const study_definition *study, size_t index, const char *const *sets,
                   size_t set_count, fe_tree *tree, fe_report *report);

/* chain.c: the cases in chains, along which a state is handed on; without `follow` of one each. */
size_t study_chains(const study_definition *study);
size_t study_chain_length(const study_definition *study);
size_t study_chained(const study_definition *study, size_t chain, size_t position); /* a case */

/* A point of the Sobol sequence in [0,1), of the dimension from 0; a seed other than 0 shifts it.
 */
enum { STUDY_SOBOL_DIMENSIONS = 16 };
double study_sobol(uint32_t index, uint32_t dimension, uint64_t seed);

enum study_rerun { STUDY_RERUN_NONE, STUDY_RERUN_FAILED, STUDY_RERUN_ALL };

/* What taking over results of stages has saved. */
typedef struct study_reuse_counts {
    size_t computed, reused; /* stages */
    double spent, saved;     /* s, in the first, and of the second when they were computed */
} study_reuse_counts;

/* Of all cases in the directory; zero when there is no study in it. */
study_reuse_counts study_savings(const char *directory);

typedef struct study_counters {
    bool leads;    /* the counters is kept in this process, not in another of the executor's */
    size_t total;  /* cases of this shard */
    size_t before; /* of those that an earlier run has done */
    size_t done;   /* with those */
    size_t failed; /* of those done */
    double seconds;
    study_reuse_counts savings; /* of the cases done in this run */
} study_counters;

enum { STUDY_KEY_SIZE = 20 }; /* of the text that tells a case from others */

/* What to run, and how. */
typedef struct study_run {
    const study_definition *study;
    const char *file; /* each case reads it anew */
    const char **sets;
    size_t set_count;
    fe_library *library;
    const char *directory;
    size_t jobs;
    const fe_service *executor; /* NULL: all work is done by workers of this process */
    size_t shard, shards;       /* this is shard `shard` of 1 to `shards` */
    size_t begin, end;          /* chains to look at, for which there is no table; end 0: all */
    enum study_rerun rerun;
    bool fail_fast;

    char (*keys)[STUDY_KEY_SIZE]; /* of all cases, where they are known or run; NULL: of no use */

    /* Writes the files of a case with series or fields into a directory. */
    bool (*write)(const fe_pipeline *pipeline, const char *directory, fe_report *report);
    /* Says what the study is, for those who read its directory. */
    const study_definition *described;
    void (*describe)(void *ctx, const study_definition *study, FILE *out);
    void (*say)(void *ctx, int indent, const char *line);        /* of a driver */
    void (*progress)(void *ctx, const study_counters *counters); /* about every second */
    void *ctx;
} study_run;

/* Runs what is not done yet, then writes table.csv. The report has what keeps the study from going
   on; failed cases are counted alone. */
bool study_execute(const study_run *run, study_counters *counters, fe_report *report);

/* The same for a study with a driver, in this process and its workers: the cases that it submits,
   then the table of those that ran and the files of the driver. */
bool study_drive(const study_run *run, study_counters *counters, fe_report *report);
/* What came of it: members for an answer, or NULL; whether it is bad, or -1: as its cases are; the
   files, "map.csv, map.svg, ", to be freed. */
struct json_t *study_facts(const study_definition *study);
int study_verdict(const study_definition *study);
char *study_files(const study_definition *study);

/* What a run would do. */
typedef struct study_plan {
    size_t done, failed, left;
    size_t again;       /* of those left, cases that an earlier run has done otherwise */
    char changed[1000]; /* why: lines such as "duty.torque: 250 N m -> 300 N m" */
    double seconds;     /* that the cases left will take, judged by those done; negative: unknown */
} study_plan;

void study_preview(const study_run *run, study_plan *plan);

/* Files of a study's directory. */
extern const char study_marker[];      /* makes a directory a study's */
extern const char study_description[]; /* what describe wrote */

/* {key: record} of all journals in the directory, which need not be there; of a key the last record
   that is good, if any. */
struct json_t *study_journal_read(const char *directory);

struct json_t *study_json_real(double value); /* null for what is no finite number */

/* FNV-1a of 64 bits, of what a file holds. */
#define STUDY_HASH_START UINT64_C(0xcbf29ce484222325)
uint64_t study_hash_file(uint64_t hash, const char *path);

/* Makes a directory with those above it; it may be there. */
bool study_make_path(const char *path);

#endif
