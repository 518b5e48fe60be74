/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One case: the file with its assignments, built, run and recorded. */
#ifndef STUDY_CASE_H
#define STUDY_CASE_H

#include "study.h"

#include <jansson.h>

/* reuse.c: results of stages on disk, for cases and runs that agree on them. */
typedef struct study_reuse_stats { /* of a stage, in this process */
    double seconds;                /* of its last evaluation; 0: unknown */
    size_t idle;                   /* bytes kept since a result was last of use */
} study_reuse_stats;

typedef struct study_reuse {
    int directory;                /* file descriptor; -1: nothing is kept */
    const uint64_t *fingerprints; /* of the case at hand */
    study_reuse_stats *stats;     /* one per stage */
    const bool *fresh;            /* stages that are not taken over; NULL: none */
    int held;                     /* locked file of the stage that is being computed; -1: none */
    char name[20];                /* of that file */
} study_reuse;

bool study_reuse_recall(study_reuse *reuse, const fe_pipeline *pipeline, fe_stage *stage);
void study_reuse_keep(study_reuse *reuse, const fe_pipeline *pipeline, const fe_stage *stage);

/* case.c */
typedef struct study_memory { /* of a worker, from case to case */
    int directory;            /* of results of stages; -1: none is kept */
    study_reuse_stats *stats;
    json_t *seen; /* {hash of a setup: true}, which a record of this worker describes */
} study_memory;

typedef struct study_case {
    fe_report *report;
    fe_tree *tree;
    fe_pipeline *pipeline; /* may be NULL after errors */
    uint64_t *fingerprints;
    char key[STUDY_KEY_SIZE];
    const json_t *states; /* {stage: state} that it starts from; NULL: it starts alone */
    char from[20];        /* hash of those */
} study_case;

void study_case_open(study_case *c, const study_run *run, size_t index);
void study_case_close(study_case *c);
json_t *study_case_set(const study_definition *study, size_t index); /* {path: value} */
bool study_case_is_good(const study_case *c);                        /* it can be run */
/* A record without outputs; reason may be NULL. */
json_t *study_case_record(const study_run *run, size_t index, const char *key, const char *status,
                          const char *reason);
/* Runs the case; NULL, with an error in c->report, when its files could not be written. */
json_t *study_case_run(study_case *c, const study_run *run, size_t index, study_memory *memory);
/* With its place where that is a table, which nothing else tells. To be freed. */
char *study_first_error(const fe_report *report);

/* setup.c */
json_t *study_case_setups(const study_case *c); /* {stage: hash of its setup} */
/* {hash: {parameter: value}} of setups that `seen` does not hold yet. */
json_t *study_case_parameters(const study_case *c, const json_t *setups, json_t *seen);
/* Prints how the case differs from a record, whose setups `parameters` describes. */
void study_setup_compare(const study_case *c, const json_t *record, const json_t *parameters,
                         FILE *out);

/* choices.c: {stage: {use, model, accuracy, promised, settings: {parameter: value}}} of the stages
   that have chosen: what it takes to choose the same again; `doubled` of a model that has no
   settings for an accuracy: its counts of cells or steps, twice as large. */
json_t *study_choices_record(const fe_pipeline *pipeline);

/* measure.c */
uint64_t study_measure_fingerprint(uint64_t fingerprint,
                                   size_t repeat); /* what the key of a repeat shows */
void study_measure_pin(void);                      /* this process to the core that it runs on */
/* Makes stages compute what the measure takes from them. */
void study_measure_want(const study_definition *study, const fe_pipeline *pipeline);
/* For each stage, to be freed: whether it is evaluated in every case. */
bool *study_measure_fresh(const study_measure *measure, const fe_pipeline *pipeline);
/* Adds what was measured to the record, and writes the outputs that matter. */
bool study_measure_record(const study_case *c, const study_run *run, size_t index, json_t *record);
/* Those: {output: {unit, rank, values, along, at}}; NULL: there are none. */
json_t *study_measure_values(const char *directory, const char *key);

#endif
