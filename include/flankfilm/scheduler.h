/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.scheduler/1": writes the script that runs a study, part by part, under the
 * scheduler of a cluster.
 *
 * A model of the kind "scheduler" that offers it is no stage of a pipeline: `submit --to NAME` uses
 * it, and `--with NAME=VALUE` sets its parameters. Parts are independent of each other, may run at
 * the same time or not, on any machine that sees the directories, and may be run again at any time:
 * what is done is not done again. On SIGTERM a part finishes the cases at hand and ends with exit
 * code 1. Code 4 means that the part is done, with cases that failed.
 */
#ifndef FLANKFILM_SCHEDULER_H
#define FLANKFILM_SCHEDULER_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FF_SCHEDULER_ID "flankfilm.scheduler/1"

/* What is called quoted stands for itself in a shell, and may hold line ends; the rest does not. */
typedef struct ff_submission {
    size_t size;
    const char *name; /* for lists of jobs: letters, digits, "-", "_" and "." */
    size_t parts;     /* numbered from 1 */
    size_t workers;   /* of a part: the cores that it can use */
    const char
        *logs; /* existing directory, absolute, for what a part prints: no '"', '\\' or '%' */
    const char *directory; /* quoted: where the command is to be run */
    const char *command;   /* quoted: runs a part, when " I/N" is appended: part I of N parts */
} ff_submission;

typedef struct ff_scheduler {
    size_t size;
    void *self;
    /* The words of the command that sends a script whose path is appended; ends with NULL. */
    const char *const *send;
    /* Calls put with one piece of the script after another. A status after host->fail. */
    ff_status (*write)(void *self, const ff_submission *job,
                       void (*put)(void *ctx, const char *text), void *ctx);
} ff_scheduler;

#ifdef __cplusplus
}
#endif
#endif
