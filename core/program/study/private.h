/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of core/program/study alone. */
#ifndef STUDY_PRIVATE_H
#define STUDY_PRIVATE_H

#include "study.h"

#include <flankfilm/executor.h>
#include <jansson.h>
#include <sys/types.h>

double study_seconds_now(void);

/* hash.c */
uint64_t study_hash(uint64_t hash, const void *data, size_t length);
uint64_t study_hash_text(uint64_t hash, const char *text); /* NULL differs from "" */
/* Model and parameters of a stage, and what is wanted of it. */
uint64_t study_hash_setup(const fe_stage *stage);
/* What the case depends on: models, parameters in SI, contents of files, what feeds what, and what
   is asked for. fingerprints: the same for each needed stage. */
uint64_t study_fingerprint(const fe_pipeline *pipeline, uint64_t *fingerprints);
/* What the results of a stage depend on that is about to be evaluated: as above, but the values
   that it is fed instead of where they come from. */
uint64_t study_hash_evaluation(const fe_pipeline *pipeline, const fe_stage *stage,
                               const uint64_t *fingerprints);

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

/* journal.c */
typedef struct study_journal {
    int fd;
    int directory; /* that it stands in, which is locked */
    double synced; /* when it was last forced to the disk */
} study_journal;

/* Takes hold of the directory and of this shard's journal in it, whose torn tail is dropped. */
bool study_journal_open(study_journal *journal, const study_run *run, fe_report *report);
bool study_journal_append(study_journal *journal, const char *line, size_t length,
                          fe_report *report);
void study_journal_close(study_journal *journal);
/* The record as a line with its checksum, to be freed. */
char *study_journal_line(const json_t *record);

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
    uint64_t fingerprint; /* of what it computes */
    char key[20];
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
bool study_record_is_ok(const json_t *record);
/* Whether a run would leave the case alone; record may be NULL. */
bool study_record_is_settled(const json_t *record, enum study_rerun rerun);

/* choices.c: {stage: {use, model, accuracy, promised, settings: {parameter: value}}} of the stages
   that have chosen: what it takes to choose the same again; `doubled` of a model that has no
   settings for an accuracy: its counts of cells or steps, twice as large. */
json_t *study_choices_record(const fe_pipeline *pipeline);

/* Adds what the stages of a case have cost and saved. */
void study_savings_add(study_reuse_counts *savings, const json_t *record);

/* setup.c */
json_t *study_case_setups(const study_case *c); /* {stage: hash of its setup} */
/* {hash: {parameter: value}} of setups that `seen` does not hold yet. */
json_t *study_case_parameters(const study_case *c, const json_t *setups, json_t *seen);
/* Prints how the case differs from a record, whose setups `parameters` describes. */
void study_setup_compare(const study_case *c, const json_t *record, const json_t *parameters,
                         FILE *out);

/* chain.c. Starts as {0}. */
typedef struct study_chain {
    size_t number, position; /* of the case that comes next */
    char key[20];            /* of the case before it; "": none */
    json_t *states;          /* {stage: bytes as text} that it starts from */
} study_chain;

void study_chain_begin(study_chain *chain, size_t number);
void study_chain_free(study_chain *chain);
/* False when no axis is followed: then each case is a chain of its own. */
bool study_is_chained(const study_definition *study);
/* The chain of a case, and its position in there. */
size_t study_chain_locate(const study_definition *study, size_t index, size_t *position);
/* Makes an opened case, the next one, part of the chain: its key depends on all before it. */
void study_chain_enter(const study_chain *chain, const study_definition *study, study_case *c);
/* The case is done; record may be NULL. */
void study_chain_pass(study_chain *chain, const study_case *c, const json_t *record);
/* States into the stages before a run, and into the record behind it. */
void study_chain_give(const study_case *c);
void study_chain_take(const study_case *c, json_t *record);
/* As study_record_is_settled, and the record started from the same states. */
bool study_case_is_settled(const study_case *c, const json_t *record, enum study_rerun rerun);

/* worker.c */
typedef struct study_worker {
    pid_t pid;              /* 0: none */
    int to, from, captured; /* pipes; the worker's stderr */
    bool busy;
    size_t chain, left; /* cases of that chain which are not handed out yet */
    size_t index;       /* of the case at hand */
    double since;
    char *line; /* of the answer, so far */
    size_t length;
    char *key; /* of the case at hand, in memory that both see */
} study_worker;

/* Starts a worker on cases that `done` does not hold. */
bool study_worker_start(study_worker *worker, const study_run *run, const json_t *done,
                        const study_worker *all, size_t count);
bool study_worker_give(study_worker *worker, size_t index);
/* 1: an answer is whole, in worker->line; 0: not yet; -1: the worker is gone. */
int study_worker_read(study_worker *worker);
/* A pair of pipes, and all of the data into one. */
bool study_open_pipes(int to[2], int from[2]);
bool study_write_all(int fd, const void *data, size_t size);
/* Collects a worker that is gone; why it went, to be freed. */
char *study_worker_reap(study_worker *worker);

/* pool.c */
enum study_case_verdict {
    STUDY_VERDICT_GOOD = '+',
    STUDY_VERDICT_FAILED = '-',
    STUDY_VERDICT_KNOWN = '=',     /* an earlier run has done it */
    STUDY_VERDICT_KNOWN_BAD = '~', /* the same, and it failed then */
    STUDY_VERDICT_FATAL = '!'      /* the study cannot go on */
};

typedef struct study_pool {
    const study_run *run;
    json_t *done; /* records of earlier runs, and of chains that are under way */
    bool ending;  /* chains are broken off behind the case at hand */
    int also;     /* input on this file, too, ends the waiting of study_pool_take; -1: none */
    study_worker *workers; /* run->jobs of them */
    struct pollfd *polled;
    size_t turn; /* the worker to look at first */
    int cause;   /* errno of a worker that could not be started */
    char *answer;
} study_pool;

void study_pool_open(study_pool *pool, const study_run *run, json_t *done);
void study_pool_close(study_pool *pool);              /* waits for the cases at hand */
void study_pool_give(study_pool *pool, size_t chain); /* not more than run->jobs at a time */
/* FF_TASK_NONE, or with pool->answer FF_TASK_ANSWER or FF_TASK_OVER; waits 0.2 s at most. */
int study_pool_take(study_pool *pool, int milliseconds, size_t *task);

/* fork-server.c: a pool in a process of its own, which forks workers when this one no longer can.
 */
typedef struct study_fork_server {
    pid_t pid;
    int to, from; /* pipes */
    char *answer;
} study_fork_server;

bool study_fork_server_start(study_fork_server *server, const study_run *run);
void study_fork_server_give(study_fork_server *server, size_t chain);
/* As study_pool_take; FF_TASK_GONE when its process is gone. */
int study_fork_server_take(study_fork_server *server, int milliseconds, size_t *task);
void study_fork_server_end(study_fork_server *server); /* with the cases at hand */

/* file.c: a text file in the study's directory; hint may be NULL. */
bool study_put_file(const char *directory, const char *name, const char *text, const char *hint,
                    fe_report *report);
/* Writes what the study is beside its journal. */
bool study_describe(const study_run *run, fe_report *report);

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

/* axes.c: time_limit and memory_limit; errors for keys that are not in the list, which NULL ends.
 */
bool study_check_keys(const fe_node *map, const char *where, const char *const *known,
                      fe_report *report);
bool study_read_limits(study_definition *study, const fe_node *node, fe_report *report);

typedef struct study_driver study_driver;

/* table.c: table.csv. keys: of all cases. */
bool study_table_write(const study_run *run, char (*keys)[STUDY_KEY_SIZE], fe_report *report);

#endif
