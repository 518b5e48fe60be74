/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A study: many cases of one pipeline. A case is the file with some assignments, like those of
 * --set, laid over it. What a case gave is one line of a journal in the study's directory.
 */
#ifndef FF_STUDY_H
#define FF_STUDY_H

#include "../pipeline/tool.h"
#include "../value/memory.h"

struct json_t;

/* A path with the values that it takes along one axis. */
typedef struct ff_varied {
    const char *path; /* as --set takes it, or the name of what the axis stands for */
    size_t axis;
    const char **assignments; /* "path=value in YAML", one for each point of the axis; "": none */
    const char **names;       /* of the points; NULL: they are called by their values */
    ff_place place;           /* of the path in its file; source NULL: it stands in none */
    const ff_node *values;    /* one for each point; NULL: they are made */
} ff_varied;

/* What the cases of a study say beyond their scalars, at which cost: see measure.c. */
typedef struct ff_measure {
    const ff_node *request; /* the list of outputs, which takes the place of the file's */
    const char *along;      /* the series that others are plotted against; NULL: one is found */
    const char **knobs;     /* stages in which cases differ: these and those that they feed are
                               evaluated in every case */
    size_t knob_count;
    bool all;             /* every stage is */
    const size_t *repeat; /* of each case, from 0; it is part of what makes a case */
} ff_measure;

typedef struct ff_study {
    ff_varied *varied; /* those of a zip or a sample share their axis */
    size_t varied_count;
    size_t *points; /* of each axis; the cases are the product, the last axis varies fastest */
    size_t axis_count;
    size_t count;        /* of cases */
    size_t followed;     /* axis along which each case starts from its neighbour's state */
    size_t way;          /* axis of the two ways, up and down; both are axis_count where none is */
    bool backwards;      /* from the last point of `followed` to the first */
    double time_limit;   /* s for a case; 0: none */
    double memory_limit; /* bytes for a worker; 0: its share of the machine's */
    const ff_node *request;    /* the list of outputs in place of the file's; NULL: those */
    const char *const *extras; /* other results, "stage.name", where there are such */
    size_t extra_count;
    const ff_measure *measure;    /* NULL: nothing is measured */
    struct json_t *const *starts; /* what each case starts from; NULL: alone, or in its chain */
    struct ff_desk *desk;         /* of the model that drives it; NULL: all cases are known */
    bool lay_first;               /* the first case shows what holds for all */
    ff_arena arena;
} ff_study;

/* Reads what stands under `study:`. With errors in the report NULL, or a study that must not be
   run: it outlives the printing. The library and the tree of the node outlive the study. */
ff_study *ff_study_open(const ff_node *node, ff_library *library, ff_report *report);
void ff_study_free(ff_study *study);

/* Words that stand under `study:` beside those that name models; NULL behind the last. */
extern const char *const ff_study_keys[];

/* The same where no model drives the study. */
ff_study *ff_study_read(const ff_node *node, ff_report *report);

/* Of a map from paths to what they take, as under `sweep:`, or to one value. NULL after an error.
 */
ff_study *ff_study_expand(const ff_node *sweep, ff_report *report);

/* Reads its axes; `alone`: without any there is one case, too. */
bool ff_study_read_axes(ff_study *study, const ff_node *node, bool alone, ff_report *report);

/* model.c: whether the pipeline, as its file stands, has what the model of the study names. */
void ff_study_check(const ff_study *study, const ff_pipeline *pipeline, ff_report *report);
const char *ff_study_cases(const ff_study *study);   /* what they are called: "cases" */
const char *ff_study_further(const ff_study *study); /* which may follow; "": none */
bool ff_study_sweeps(const ff_study *study); /* its cases are those of a sweep: all are known */
const char *ff_study_name(const ff_study *study); /* the key that names its model; "": none */

/* Path k of a case: what it assigns, as "path=value" or ""; its point; the point's name. */
const char *ff_study_assignment(const ff_study *study, size_t k, size_t index);
const char *ff_varied_value(const ff_varied *varied, size_t point);
const char *ff_study_value(const ff_study *study, size_t k, size_t index);
size_t ff_study_rank(const ff_study *study, size_t axis, size_t index);

/* Lays a case over a tree: the files that it includes, `sets` over them, and its values on top. */
void ff_study_lay(const ff_study *study, size_t index, const char *const *sets, size_t set_count,
                  ff_tree *tree, ff_report *report);

/* chain.c: the cases in chains, along which a state is handed on; without `follow` of one each. */
size_t ff_study_chains(const ff_study *study);
size_t ff_study_chain_length(const ff_study *study);
size_t ff_study_chained(const ff_study *study, size_t chain, size_t position); /* a case */

/* A point of the Sobol sequence in [0,1), of the dimension from 0; a seed other than 0 shifts it.
 */
enum { FF_SOBOL_DIMENSIONS = 16 };
double ff_sobol(uint32_t index, uint32_t dimension, uint64_t seed);

enum ff_rerun { FF_RERUN_NONE, FF_RERUN_FAILED, FF_RERUN_ALL };

/* What taking over results of stages has saved. */
typedef struct ff_savings {
    size_t computed, reused; /* stages */
    double spent, saved;     /* s, in the first, and of the second when they were computed */
} ff_savings;

/* Of all cases in the directory; zero when there is no study in it. */
ff_savings ff_study_savings(const char *directory);

typedef struct ff_tally {
    bool leads;    /* the tally is kept in this process, not in another of the executor's */
    size_t total;  /* cases of this shard */
    size_t before; /* of those that an earlier run has done */
    size_t done;   /* with those */
    size_t failed; /* of those done */
    double seconds;
    ff_savings savings; /* of the cases done in this run */
} ff_tally;

enum { FF_KEY_SIZE = 20 }; /* of the text that tells a case from others */

/* What to run, and how. */
typedef struct ff_campaign {
    const ff_study *study;
    const char *file; /* each case reads it anew */
    const char **sets;
    size_t set_count;
    ff_library *library;
    const char *directory;
    size_t jobs;
    const ff_tool *executor; /* NULL: all work is done by workers of this process */
    size_t shard, shards;    /* this is shard `shard` of 1 to `shards` */
    size_t begin, end;       /* chains to look at, for which there is no table; end 0: all */
    enum ff_rerun rerun;
    bool fail_fast;
    bool paranoid; /* guards around every call into a model */

    char (*keys)[FF_KEY_SIZE]; /* of all cases, where they are known or run; NULL: of no use */

    /* Writes the files of a case with series or fields into a directory. */
    bool (*write)(const ff_pipeline *pipeline, const char *directory, ff_report *report);
    /* Says what the study is, for those who read its directory. */
    const ff_study *described;
    void (*describe)(void *ctx, const ff_study *study, FILE *out);
    void (*say)(void *ctx, int indent, const char *line); /* of a model that drives the study */
    void (*progress)(void *ctx, const ff_tally *tally);   /* about every second */
    void *ctx;
} ff_campaign;

/* Runs what is not done yet, then writes table.csv. The report has what keeps the study from going
   on; failed cases are counted alone. */
bool ff_study_run(const ff_campaign *campaign, ff_tally *tally, ff_report *report);

/* The same for a study that a model drives, in this process and its workers: the cases that it asks
   for, then the table of those that ran and the files of the model. */
bool ff_study_drive(const ff_campaign *campaign, ff_tally *tally, ff_report *report);
/* What came of it: members for an answer, or NULL; whether it is bad, or -1: the model does not
   say; the files, "map.csv, map.svg, ", to be freed. */
const struct json_t *ff_study_facts(const ff_study *study);
int ff_study_verdict(const ff_study *study);
char *ff_study_files(const ff_study *study);

/* What a run would do. */
typedef struct ff_plan {
    size_t done, failed, left;
    size_t again;       /* of those left, cases that an earlier run has done otherwise */
    char changed[1000]; /* why: lines such as "duty.torque: 250 N m -> 300 N m" */
    double seconds;     /* that the cases left will take, judged by those done; negative: unknown */
} ff_plan;

void ff_study_foresee(const ff_campaign *campaign, ff_plan *plan);

/* Makes the directory one of a study, where nothing has run yet. */
bool ff_study_claim(const char *directory, ff_report *report);

/* The text as one word of a shell. */
void ff_put_quoted(FILE *out, const char *text);

/* Files of a study's directory. */
extern const char ff_study_marker[];      /* makes a directory a study's */
extern const char ff_study_description[]; /* what describe wrote */

/* {key: record} of all journals in the directory, which need not be there; of a key the last record
   that is good, if any. */
struct json_t *ff_journal_read(const char *directory);

struct json_t *ff_json_real(double value); /* null for what is no finite number */

/* FNV-1a of 64 bits, of what a file holds. */
#define FF_HASH_START UINT64_C(0xcbf29ce484222325)
uint64_t ff_hash_file(uint64_t hash, const char *path);

/* Makes a directory with those above it; it may be there. */
bool ff_make_path(const char *path);

#endif
