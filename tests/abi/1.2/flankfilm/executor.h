/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.executor/1": spreads the tasks of a study over processes.
 *
 * A model of the kind "executor" that offers it is no stage of a pipeline: `--executor NAME` uses
 * it. The same command line is started in every process that takes part - how, is the user's or
 * the scheduler's affair - and each calls `run` once. One of them leads: it alone takes numbers of
 * tasks from the study and writes the journal. Any of them works on tasks that reach it, also the
 * one that leads. The executor carries numbers one way and answers, which are opaque bytes, the
 * other way. All of it in one process, as an example:
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
 * A task runs in a process of its own that stems from before `run`: whatever a model does there -
 * crash, hang, eat memory - comes back as an answer, and nothing that `run` opens is inherited.
 */
#ifndef FLANKFILM_EXECUTOR_H
#define FLANKFILM_EXECUTOR_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FF_EXECUTOR_ID "flankfilm.executor/1"

/* What take found. */
enum {
    FF_TASK_GONE = -1,  /* the tasks of this process cannot go on: end `run` */
    FF_TASK_NONE = 0,   /* nothing yet */
    FF_TASK_ANSWER = 1, /* an answer; more of the same task follow */
    FF_TASK_OVER = 2    /* the last answer of a task: its slot is free */
};

/* What the program hands to an executor; valid during `run`, for the thread that called it. */
typedef struct ff_tasks {
    size_t size;
    void *ctx;    /* first argument of every function below */
    size_t slots; /* tasks that this process can work on at a time */

    /* In the leading process. `lead` comes first, before a task is given anywhere; negative: the
       results cannot be written, so end `run` everywhere. `next`: 0 when none is left, also since
       the study is to stop: those at work are still to be waited for. */
    int32_t (*lead)(void *ctx);
    int32_t (*next)(void *ctx, size_t *task);
    void (*note)(void *ctx, const void *answer, size_t size);

    /* In every process. `give` needs a free slot and never waits; `take` waits up to `milliseconds`
       for an answer, which is valid until the next call. */
    void (*give)(void *ctx, size_t task);
    int32_t (*take)(void *ctx, int32_t milliseconds, size_t *task, const void **answer,
                    size_t *size);
} ff_tasks;

typedef struct ff_executor {
    size_t size;
    void *self;
    /* Returns when all is done, in every process. FF_OK, or a status after host->fail. Processes
       and threads, communicators and sockets begin here and end here. */
    ff_status (*run)(void *self, const ff_tasks *tasks);
} ff_executor;

#ifdef __cplusplus
}
#endif
#endif
