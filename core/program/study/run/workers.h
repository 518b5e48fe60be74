/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The worker processes that run cases. */
#ifndef STUDY_WORKERS_H
#define STUDY_WORKERS_H

#include "../cases/case.h"
#include "../store/records.h"

#include <flankfilm/executor.h>
#include <jansson.h>
#include <sys/types.h>

/* worker.c */
typedef struct study_worker {
    pid_t pid; /* 0 if there is no process */
    /* descriptors: the two pipes, and the file that receives the worker's stderr */
    int to, from, captured;
    bool busy;
    size_t chain, left; /* its chain, and the number of cases of that chain not yet sent */
    size_t index;       /* index of the running case */
    double case_start;  /* time when the running case was sent, s */
    int stops;          /* how many times in a row the worker was found stopped */
    char *line;         /* part of the answer that has been read */
    size_t length;
    study_shared *shared; /* memory shared with the worker */
    off_t synced;         /* length of its log that is on the disk */
} study_worker;

/* Starts a worker process of the pool. The worker skips cases that pool->done contains. The process
   closes descriptors that belong to others: the store and the pipes of the other workers. */
struct study_pool;
bool study_worker_start(study_worker *worker, const struct study_pool *pool);
bool study_worker_send_case(study_worker *worker, const study_run *run, size_t index);
/* Returns 1 if the answer in worker->line is complete, 0 if it is not complete yet, -1 if the
   worker has ended. */
int study_worker_read(study_worker *worker);
bool study_open_pipes(int to[2], int from[2]); /* false after an error */
/* Ends a worker and the processes that its plugins have started. */
void study_worker_kill(const study_worker *worker);
/* Returns whether the worker has ended, even if a process that it started keeps its pipe open. */
bool study_worker_is_gone(study_worker *worker);
/* Returns whether its log is longer than the part on the disk. The second function forces it to the
   disk, and returns false with errno. */
bool study_worker_is_ahead(const study_worker *worker);
bool study_worker_sync(study_worker *worker, const study_run *run);
/* Waits for the end of a worker, ends processes that its plugins have started, and returns why it
   ended, to be freed. */
char *study_worker_reap(study_worker *worker);

/* pool.c */
enum study_case_verdict {
    STUDY_VERDICT_GOOD = '+',
    STUDY_VERDICT_FAILED = '-',
    STUDY_VERDICT_KNOWN = '=',     /* an earlier run has finished the case */
    STUDY_VERDICT_KNOWN_BAD = '~', /* the same, and the case failed */
    STUDY_VERDICT_FATAL = '!',     /* the study cannot continue */
    STUDY_VERDICT_WRITTEN_OVER =
        '?' /* the same, because a plugin's file was overwritten; its path follows */
};

typedef struct study_pool {
    const study_run *run;
    study_records *done;   /* records of earlier runs, and of this run if cases form chains */
    json_t *written_forms; /* forms already written, for records of crashed cases */
    bool ending;           /* whether chains stop after the running case */
    int hidden[2];         /* descriptors of others that workers close; -1: none */
    int extra_fd;          /* a further descriptor whose input ends the waiting; -1: none */
    study_worker *workers; /* run->jobs workers */
    struct pollfd *polled;
    size_t turn; /* the worker that is checked first */
    int cause;   /* errno of a worker that could not be started */
    char *answer;
    bool groups; /* whether answers are held back until their arrays are on the disk, while their
                    workers continue, so that one sync serves several cases */
    char **held;
    size_t held_count, released;  /* number of answers held back, and how many of them have been
                                     released */
    double held_since, sync_time; /* in s: time when the first one was held back; duration of the
                                     last sync */
} study_pool;

void study_pool_open(study_pool *pool, const study_run *run, study_records *done);
void study_pool_close(study_pool *pool);      /* waits for the running cases */
void study_pool_kill(const study_pool *pool); /* ends all workers at once */
/* Starts the next chain; at most run->jobs chains may run at a time. */
void study_pool_start_chain(study_pool *pool, size_t chain);
/* Waits at most `milliseconds`, and never longer than 0.2 s. Returns FF_TASK_NONE, FF_TASK_ANSWER
   with pool->answer set, or FF_TASK_OVER if that answer finishes its chain. If answers are held
   back, pool->answer may be NULL with FF_TASK_OVER, and a later FF_TASK_ANSWER brings it. */
int study_pool_wait(study_pool *pool, int milliseconds, size_t *task);

/* fork-server.c: a pool in a separate process, which can fork workers even if an executor does not
   allow this process to do so. */
typedef struct study_fork_server {
    pid_t pid;
    int to, from; /* pipes */
    char *answer;
} study_fork_server;

bool study_fork_server_start(study_fork_server *server, const study_run *run);
void study_fork_server_start_chain(study_fork_server *server, size_t chain);
/* Waits as study_pool_wait does. Returns FF_TASK_GONE if the fork server has ended. */
int study_fork_server_wait(study_fork_server *server, int milliseconds, size_t *task);
void study_fork_server_end(study_fork_server *server); /* waits for the running cases */

#endif
