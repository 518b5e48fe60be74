/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of core/study alone. */
#ifndef FF_STUDY_PRIVATE_H
#define FF_STUDY_PRIVATE_H

#include "study.h"

#include <flankfilm/executor.h>
#include <jansson.h>
#include <sys/types.h>

double ff_seconds_now(void);

/* hash.c */
uint64_t ff_hash(uint64_t hash, const void *data, size_t length);
uint64_t ff_hash_text(uint64_t hash, const char *text); /* NULL differs from "" */
/* Model and parameters of a stage, and what is wanted of it. */
uint64_t ff_hash_setup(const ff_stage *stage);
/* What the case depends on: models, parameters in SI, contents of files, what feeds what, and what
   is asked for. prints: the same for each needed stage. */
uint64_t ff_fingerprint(const ff_pipeline *pipeline, uint64_t *prints);
/* What the results of a stage depend on that is about to be evaluated: as above, but the values
   that it is fed instead of where they come from. */
uint64_t ff_hash_evaluation(const ff_pipeline *pipeline, const ff_stage *stage,
                            const uint64_t *prints);

/* reuse.c: results of stages on disk, for cases and runs that agree on them. */
typedef struct ff_habit { /* of a stage, in this process */
    double seconds;       /* of its last evaluation; 0: unknown */
    size_t idle;          /* bytes kept since a result was last of use */
} ff_habit;

typedef struct ff_reuse {
    int directory;          /* file descriptor; -1: nothing is kept */
    const uint64_t *prints; /* of the case at hand */
    ff_habit *habits;       /* one per stage */
    const bool *fresh;      /* stages that are not taken over; NULL: none */
    int held;               /* locked file of the stage that is being computed; -1: none */
    char name[20];          /* of that file */
} ff_reuse;

bool ff_reuse_recall(ff_reuse *reuse, const ff_pipeline *pipeline, ff_stage *stage);
void ff_reuse_keep(ff_reuse *reuse, const ff_pipeline *pipeline, const ff_stage *stage);

/* journal.c */
typedef struct ff_journal {
    int fd;
    int directory; /* that it stands in, which is locked */
    double synced; /* when it was last forced to the disk */
} ff_journal;

/* Takes hold of the directory and of this shard's journal in it, whose torn tail is dropped. */
bool ff_journal_open(ff_journal *journal, const ff_campaign *campaign, ff_report *report);
bool ff_journal_append(ff_journal *journal, const char *line, size_t length, ff_report *report);
void ff_journal_close(ff_journal *journal);
/* The record as a line with its checksum, to be freed. */
char *ff_journal_line(const json_t *record);

/* case.c */
typedef struct ff_memory { /* of a worker, from case to case */
    int directory;         /* of results of stages; -1: none is kept */
    ff_habit *habits;
    json_t *seen; /* {hash of a setup: true}, which a record of this worker describes */
} ff_memory;

typedef struct ff_case {
    ff_report *report;
    ff_tree *tree;
    ff_pipeline *pipeline; /* may be NULL after errors */
    uint64_t *prints;
    uint64_t print; /* of what it computes */
    char key[20];
    const json_t *states; /* {stage: state} that it starts from; NULL: it starts alone */
    char from[20];        /* hash of those */
} ff_case;

void ff_case_open(ff_case *c, const ff_campaign *campaign, size_t index);
void ff_case_close(ff_case *c);
json_t *ff_case_set(const ff_study *study, size_t index); /* {path: value} */
bool ff_case_is_good(const ff_case *c);                   /* it can be run */
/* A record without outputs; reason may be NULL. */
json_t *ff_case_record(const ff_campaign *campaign, size_t index, const char *key,
                       const char *status, const char *reason);
/* Runs the case; NULL, with an error in c->report, when its files could not be written. */
json_t *ff_case_run(ff_case *c, const ff_campaign *campaign, size_t index, ff_memory *memory);
/* With its place where that is a table, which nothing else tells. To be freed. */
char *ff_first_error(const ff_report *report);
bool ff_record_is_ok(const json_t *record);
/* Whether a run would leave the case alone; record may be NULL. */
bool ff_record_stands(const json_t *record, enum ff_rerun rerun);

/* choices.c: {stage: {use, model, accuracy, promised, settings: {parameter: value}}} of the stages
   that have chosen: what it takes to choose the same again; `doubled` of a model that has no
   settings for an accuracy: its counts of cells or steps, twice as large. */
json_t *ff_choices_record(const ff_pipeline *pipeline);

/* Adds what the stages of a case have cost and saved. */
void ff_savings_add(ff_savings *savings, const json_t *record);

/* setup.c */
json_t *ff_case_setups(const ff_case *c); /* {stage: hash of its setup} */
/* {hash: {parameter: value}} of setups that `seen` does not hold yet. */
json_t *ff_case_parameters(const ff_case *c, const json_t *setups, json_t *seen);
/* Prints how the case differs from a record, whose setups `parameters` describes. */
void ff_setup_compare(const ff_case *c, const json_t *record, const json_t *parameters, FILE *out);

/* chain.c. Starts as {0}. */
typedef struct ff_chain {
    size_t number, position; /* of the case that comes next */
    char key[20];            /* of the case before it; "": none */
    json_t *states;          /* {stage: bytes as text} that it starts from */
} ff_chain;

void ff_chain_begin(ff_chain *chain, size_t number);
void ff_chain_free(ff_chain *chain);
/* Goes on, without running, up to the case `index`. */
void ff_chain_reach(ff_chain *chain, const ff_campaign *campaign, size_t index, const json_t *done);
/* Makes an opened case, the next one, part of the chain: its key depends on all before it; that of
   a case that has a start of its own, on that. */
void ff_chain_enter(const ff_chain *chain, const ff_study *study, ff_case *c);
/* What the case started from in its chain, by the records of those before it: a new reference.
   NULL: there are no chains. */
json_t *ff_chain_start(const ff_study *study, size_t index, char (*keys)[FF_KEY_SIZE],
                       const json_t *records);
/* The case is done; record may be NULL. */
void ff_chain_pass(ff_chain *chain, const ff_case *c, const json_t *record);
/* States into the stages before a run, and into the record behind it. */
void ff_chain_give(const ff_case *c);
void ff_chain_take(const ff_case *c, json_t *record);
/* As ff_record_stands, and the record started from the same states. */
bool ff_case_stands(const ff_case *c, const json_t *record, enum ff_rerun rerun);

/* worker.c */
typedef struct ff_worker {
    pid_t pid;          /* 0: none */
    int to, from, said; /* pipes; the worker's stderr */
    bool busy;
    size_t chain, left; /* cases of that chain which are not handed out yet */
    size_t index;       /* of the case at hand */
    double since;
    char *line; /* of the answer, so far */
    size_t length;
    char *key; /* of the case at hand, in memory that both see */
} ff_worker;

/* Starts a worker on cases that `done` does not hold. */
bool ff_worker_start(ff_worker *worker, const ff_campaign *campaign, const json_t *done,
                     const ff_worker *all, size_t count);
bool ff_worker_give(ff_worker *worker, size_t index);
/* 1: an answer is whole, in worker->line; 0: not yet; -1: the worker is gone. */
int ff_worker_read(ff_worker *worker);
/* A pair of pipes, and all of the data into one. */
bool ff_open_pipes(int to[2], int from[2]);
bool ff_put_all(int fd, const void *data, size_t size);
/* Collects a worker that is gone; why it went, to be freed. */
char *ff_worker_bury(ff_worker *worker);

/* pool.c */
enum ff_verdict {
    FF_VERDICT_GOOD = '+',
    FF_VERDICT_FAILED = '-',
    FF_VERDICT_KNOWN = '=',     /* an earlier run has done it */
    FF_VERDICT_KNOWN_BAD = '~', /* the same, and it failed then */
    FF_VERDICT_FATAL = '!'      /* the study cannot go on */
};

typedef struct ff_pool {
    const ff_campaign *campaign;
    json_t *done;       /* records of earlier runs, and of chains that are under way */
    bool ending;        /* chains are broken off behind the case at hand */
    int also;           /* input on this file, too, ends the waiting of ff_pool_take; -1: none */
    ff_worker *workers; /* campaign->jobs of them */
    struct pollfd *polled;
    size_t turn; /* the worker to look at first */
    int cause;   /* errno of a worker that could not be started */
    char *answer;
} ff_pool;

void ff_pool_open(ff_pool *pool, const ff_campaign *campaign, json_t *done);
void ff_pool_close(ff_pool *pool);              /* waits for the cases at hand */
void ff_pool_give(ff_pool *pool, size_t chain); /* not more than campaign->jobs at a time */
/* FF_TASK_NONE, or with pool->answer FF_TASK_ANSWER or FF_TASK_OVER; waits 0.2 s at most. */
int ff_pool_take(ff_pool *pool, int milliseconds, size_t *task);

/* nursery.c: a pool in a process of its own, which forks workers when this one no longer can. */
typedef struct ff_nursery {
    pid_t pid;
    int to, from; /* pipes */
    char *answer;
} ff_nursery;

bool ff_nursery_start(ff_nursery *nursery, const ff_campaign *campaign);
void ff_nursery_give(ff_nursery *nursery, size_t chain);
/* As ff_pool_take; FF_TASK_GONE when its process is gone. */
int ff_nursery_take(ff_nursery *nursery, int milliseconds, size_t *task);
void ff_nursery_end(ff_nursery *nursery); /* with the cases at hand */

/* file.c: a text file in the study's directory; hint may be NULL. */
bool ff_put_file(const char *directory, const char *name, const char *text, const char *hint,
                 ff_report *report);
/* Writes what the study is beside its journal. */
bool ff_describe(const ff_campaign *campaign, ff_report *report);

/* measure.c */
uint64_t ff_measure_print(uint64_t print, size_t repeat); /* what the key of a repeat shows */
void ff_measure_pin(void); /* this process to the core that it runs on */
/* Makes stages compute what the measure takes from them. */
void ff_measure_want(const ff_study *study, const ff_pipeline *pipeline);
/* For each stage, to be freed: whether it is evaluated in every case. */
bool *ff_measure_fresh(const ff_measure *measure, const ff_pipeline *pipeline);
/* Adds what was measured to the record, and writes the outputs that matter. */
bool ff_measure_record(const ff_case *c, const ff_campaign *campaign, size_t index, json_t *record);
/* Those: {output: {unit, rank, values, along, at}}; NULL: there are none. */
json_t *ff_measure_values(const char *directory, const char *key);

/* axes.c: time_limit and memory_limit; errors for keys that are not in the list, which NULL ends.
 */
bool ff_study_check_keys(const ff_node *map, const char *where, const char *const *known,
                         ff_report *report);
bool ff_study_read_limits(ff_study *study, const ff_node *node, ff_report *report);

/* model.c */
typedef struct ff_desk ff_desk;
void ff_desk_free(ff_desk *desk); /* accepts NULL */
/* The stage of "stage.name", or NULL; in *param the number of its parameter in use that is named
   there and holds a number, or SIZE_MAX. */
const ff_stage *ff_knob_of(const ff_pipeline *pipeline, const char *path, size_t *param);

/* table.c: table.csv. keys: of all cases. */
bool ff_table_write(const ff_campaign *campaign, char (*keys)[FF_KEY_SIZE], ff_report *report);

#endif
