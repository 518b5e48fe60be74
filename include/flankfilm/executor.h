/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.executor/1": distributes the tasks of a study over processes.
 *
 * A model of kind "executor" is not a stage of a pipeline; `--executor NAME` selects it. The user
 * or the scheduler starts the same command line in each process, and each process calls `run` once.
 * One process leads: it alone takes task numbers from the study and writes the journal. Every
 * process works on the tasks that it receives, and so does the leading one. The executor transports
 * task numbers in one direction and answers, which are opaque bytes, in the other. A complete
 * example for a single process:
 *
 *     size_t task, size, busy = 0;
 *     const void *answer;
 *     int32_t state = t->lead(t->ctx);
 *     while (state >= 0) {
 *         for (; busy < t->slots && t->next(t->ctx, &task); busy++)
 *             t->give(t->ctx, task);
 *         if (busy == 0)
 *             return FF_OK;
 *         state = t->take(t->ctx, 1000, &task, &answer, &size);
 *         if (state > 0)
 *             t->note(t->ctx, answer, size);
 *         busy -= state == FF_TASK_OVER;
 *     }
 *     return FF_STOPPED;
 *
 * A task runs in a process of its own, forked from a process that was started before `run`. If a
 * model crashes, hangs or exhausts the memory, this is reported as an answer. The task process
 * inherits nothing that `run` opens.
 */
#ifndef FLANKFILM_EXECUTOR_H
#define FLANKFILM_EXECUTOR_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FF_EXECUTOR_ID "flankfilm.executor/1"

/* Result of `take`. */
enum {
    FF_TASK_GONE = -1,  /* this process can run no more tasks: end `run` */
    FF_TASK_NONE = 0,   /* no answer yet */
    FF_TASK_ANSWER = 1, /* an answer; more answers of the same task follow */
    FF_TASK_OVER = 2    /* the last answer of a task; its slot is free again */
};

/* The functions that the program gives to an executor; only the thread that called `run` may use
   them, during `run`. */
typedef struct ff_tasks {
    size_t size;
    void *ctx;    /* first argument of every function below */
    size_t slots; /* number of tasks that this process can run in parallel */

    /* For the leading process. Call `lead` first, before any task is given to a process; if it is
       negative, results cannot be written: end `run` in all processes. `next` returns 0 if no task
       is left or the study is to stop; then wait for the running tasks. */
    int32_t (*lead)(void *ctx);
    int32_t (*next)(void *ctx, size_t *task);
    void (*note)(void *ctx, const void *answer, size_t size);

    /* For every process. `give` starts a task; it needs a free slot and never waits. `take` waits
       up to `milliseconds` for an answer, which is valid until the next call. */
    void (*give)(void *ctx, size_t task);
    int32_t (*take)(void *ctx, int32_t milliseconds, size_t *task, const void **answer,
                    size_t *size);
} ff_tasks;

typedef struct ff_executor {
    size_t size;
    void *self;
    /* Returns when all tasks are done, in every process: FF_OK, or a status after host->fail. All
       processes, threads, communicators and sockets of the executor are created and closed inside
       `run`. */
    ff_status (*run)(void *self, const ff_tasks *tasks);
} ff_executor;

#ifdef __cplusplus
}
#endif
#endif
