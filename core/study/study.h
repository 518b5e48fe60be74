/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A study: many cases of one pipeline. A case is the file with some assignments, like those of
 * --set, laid over it. What a case gave is one line of a journal in the study's directory.
 */
#ifndef FF_STUDY_H
#define FF_STUDY_H

#include "../pipeline/pipeline.h"
#include "../value/memory.h"

/* A path with the values that it takes along one axis. */
typedef struct ff_varied {
    const char *path; /* as --set takes it */
    size_t axis;
    const char **assignments; /* "path=value in YAML", one for each point of the axis */
} ff_varied;

typedef struct ff_study {
    ff_varied *varied; /* those of a zip or a sample share their axis */
    size_t varied_count;
    size_t *points; /* of each axis; the cases are the product, the last axis varies fastest */
    size_t axis_count;
    size_t count;        /* of cases */
    double time_limit;   /* s for a case; 0: none */
    double memory_limit; /* bytes for a worker; 0: its share of the machine's */
    ff_arena arena;
} ff_study;

/* Reads what stands under `study:`. NULL with errors in the report. */
ff_study *ff_study_read(const ff_node *node, ff_report *report);
void ff_study_free(ff_study *study);

/* What the case assigns to path k, as "path=value", and the value alone. */
const char *ff_study_assignment(const ff_study *study, size_t k, size_t index);
const char *ff_varied_value(const ff_varied *varied, size_t point);
const char *ff_study_value(const ff_study *study, size_t k, size_t index);

/* A point of the Sobol sequence in [0,1), of the dimension from 0; a seed other than 0 shifts it.
 */
enum { FF_SOBOL_DIMENSIONS = 16 };
double ff_sobol(uint32_t index, uint32_t dimension, uint64_t seed);

enum ff_rerun { FF_RERUN_NONE, FF_RERUN_FAILED, FF_RERUN_ALL };

typedef struct ff_tally {
    size_t total;  /* cases of this shard */
    size_t before; /* of those that an earlier run has done */
    size_t done;   /* with those */
    size_t failed; /* of those done */
    size_t reused; /* of those done, cases that took over results of stages */
    double seconds;
} ff_tally;

/* What to run, and how. */
typedef struct ff_campaign {
    const ff_study *study;
    const char *file; /* each case reads it anew */
    const char **sets;
    size_t set_count;
    ff_library *library;
    const char *directory;
    size_t jobs;
    size_t shard, shards; /* this is shard `shard` of 1 to `shards` */
    enum ff_rerun rerun;
    bool fail_fast;

    /* Writes the files of a case with series or fields into a directory. */
    bool (*write)(const ff_pipeline *pipeline, const char *directory, ff_report *report);
    void (*progress)(void *ctx, const ff_tally *tally); /* about every second */
    void *ctx;
} ff_campaign;

/* Runs what is not done yet, then writes table.csv. The report has what keeps the study from going
   on; failed cases are counted alone. */
bool ff_study_run(const ff_campaign *campaign, ff_tally *tally, ff_report *report);

/* What a run would do. */
typedef struct ff_plan {
    size_t done, failed, left;
    char changed[200]; /* stages that make cases run again: "duty, mesh"; may be "" */
    double seconds;    /* that the cases left will take, judged by those done; negative: unknown */
} ff_plan;

void ff_study_plan(const ff_campaign *campaign, ff_plan *plan);

/* Makes a directory with those above it; it may be there. */
bool ff_make_path(const char *path);

#endif
