/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The processes that run cases. */
#ifndef STUDY_WORKERS_H
#define STUDY_WORKERS_H

#include "study.h"

#include <flankfilm/executor.h>
#include <jansson.h>
#include <sys/types.h>

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

#endif
