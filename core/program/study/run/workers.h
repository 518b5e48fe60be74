/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The processes that run cases. */
#ifndef STUDY_WORKERS_H
#define STUDY_WORKERS_H

#include "../cases/case.h"
#include "../store/records.h"

#include <flankfilm/executor.h>
#include <jansson.h>
#include <sys/types.h>

/* worker.c */
typedef struct study_worker {
    pid_t pid; /* 0 when there is no process */
    /* file descriptors: the two pipes, and the file that holds the worker's stderr */
    int to, from, captured;
    bool busy;
    size_t chain, left; /* its chain, and how many cases of that are not handed out yet */
    size_t index;       /* of the case that it runs */
    double since;
    int stops;  /* how often it was seen to be stopped, in a row */
    char *line; /* the answer as far as it has been read */
    size_t length;
    study_shared *shared; /* in memory that both processes share */
    off_t synced;         /* how much of that log is on the disk */
} study_worker;

/* Starts a worker process of the pool, which skips cases that pool->done holds, and closes what
   belongs to others: the store and the pipes of the other workers. */
struct study_pool;
bool study_worker_start(study_worker *worker, const struct study_pool *pool);
bool study_worker_send_case(study_worker *worker, const study_run *run, size_t index);
/* Returns 1 when the answer in worker->line is complete, 0 when it is not yet, -1 when the worker
   is gone. */
int study_worker_read(study_worker *worker);
/* Opens a pair of pipes; writes or reads all of the data. False after an error, or at the end. */
bool study_open_pipes(int to[2], int from[2]);
bool study_write_all(int fd, const void *data, size_t size);
bool study_read_all(int fd, void *data, size_t size);
/* Ends a worker and what its plugins have started. */
void study_worker_kill(const study_worker *worker);
/* Whether it has ended, although a process that it started may hold its pipe. */
bool study_worker_is_gone(study_worker *worker);
/* Whether its log has more than what is on the disk, and forces that there; false with errno. */
bool study_worker_is_ahead(const study_worker *worker);
bool study_worker_sync(study_worker *worker, const study_run *run);
/* Waits for the end of a worker, ends what its plugins have started, and returns why it ended, to
 * be freed. */
char *study_worker_reap(study_worker *worker);

/* pool.c */
enum study_case_verdict {
    STUDY_VERDICT_GOOD = '+',
    STUDY_VERDICT_FAILED = '-',
    STUDY_VERDICT_KNOWN = '=',       /* an earlier run has done the case */
    STUDY_VERDICT_KNOWN_BAD = '~',   /* the same, and it failed then */
    STUDY_VERDICT_FATAL = '!',       /* the study cannot go on */
    STUDY_VERDICT_WRITTEN_OVER = '?' /* the same: a plugin's file was, whose path follows */
};

typedef struct study_pool {
    const study_run *run;
    study_records *done; /* of earlier runs, and of this one where cases form chains */
    json_t *said;        /* the forms that records of cases that crashed have said */
    bool ending;         /* chains are broken off after the running case */
    int hidden[2];       /* descriptors that workers close, which are none of theirs; -1 for none */
    int extra_fd;        /* a further file descriptor whose input ends the waiting; -1 for none */
    study_worker *workers; /* run->jobs of them */
    struct pollfd *polled;
    size_t turn; /* the worker to look at first */
    int cause;   /* errno of a worker that could not be started */
    char *answer;
    bool groups; /* answers whose arrays are not on the disk yet are held, and their worker goes on:
                    so one sync does for several cases */
    char **held;
    size_t held_count, released;  /* how many, and how many of them were given out */
    double held_since, sync_time; /* s: of the first of them; what the last sync took */
} study_pool;

void study_pool_open(study_pool *pool, const study_run *run, study_records *done);
void study_pool_close(study_pool *pool);      /* waits for the running cases */
void study_pool_kill(const study_pool *pool); /* ends all workers, at once */
/* Starts the next chain; at most run->jobs may run at a time. */
void study_pool_start_chain(study_pool *pool, size_t chain);
/* Waits at most 0.2 s. Returns FF_TASK_NONE, or with pool->answer set FF_TASK_ANSWER or, when the
   chain is finished, FF_TASK_OVER. Where answers are held, pool->answer may be NULL then, and a
   later FF_TASK_ANSWER gives it. */
int study_pool_wait(study_pool *pool, int milliseconds, size_t *task);

/* fork-server.c: a pool in a process of its own, which can still fork workers when this process
   cannot because of the executor. */
typedef struct study_fork_server {
    pid_t pid;
    int to, from; /* pipes */
    char *answer;
} study_fork_server;

bool study_fork_server_start(study_fork_server *server, const study_run *run);
void study_fork_server_start_chain(study_fork_server *server, size_t chain);
/* As study_pool_wait; FF_TASK_GONE when its process is gone. */
int study_fork_server_wait(study_fork_server *server, int milliseconds, size_t *task);
void study_fork_server_end(study_fork_server *server); /* waits for the running cases */

#endif
