/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs the cases of a study, and determines what a run would do. */
#ifndef STUDY_RUN_H
#define STUDY_RUN_H

#include "../cases/study.h"

#include <signal.h>

/* How much the reuse of stage results has saved. */
typedef struct study_reuse_counts {
    size_t computed, reused; /* numbers of stages */
    double spent, saved;     /* times in s: that the computed stages took, and that the reused ones
                                had taken */
} study_reuse_counts;

/* Sums over all cases in the directory. All members are 0 if it contains no study. */
study_reuse_counts study_savings(const char *directory);

typedef struct study_counters {
    bool leads;    /* whether this process keeps the counters; only one process of an executor
                      does */
    size_t total;  /* number of cases of this shard */
    size_t before; /* how many of these were done by an earlier run */
    size_t done;   /* number of all cases done, including `before` */
    size_t failed; /* failed ones among the done cases */
    double seconds;
    study_reuse_counts savings; /* savings of the cases done in this run */
    study_tally tally;          /* verdicts of the done cases; freed by study_tally_free */
} study_counters;

/* Adds the cost and the savings of a case's stages. `record` may be NULL. */
void study_savings_add(study_reuse_counts *savings, const json_t *record);

/* recount.c: replaces the counters by a count of the rows on the disk, for the cases of this run
   that have a key. Reports cases whose rows are lost. */
bool study_recount(const study_run *run, study_records *records, char (*keys)[STUDY_KEY_SIZE],
                   study_counters *counters, ff_report *report);

/* signals.c: how SIGINT and SIGTERM were handled before. */
typedef struct study_signals {
    struct sigaction interrupt, terminate;
} study_signals;

/* Catches both signals. The first signal lets the running cases finish and stops the study, also
   between the batches of a driver. The second signal ends the process at once. */
void study_signals_catch(study_signals *before);
void study_signals_restore(const study_signals *before);
/* Sets whether this process ends the workers itself and prints a message at the first signal. */
void study_signals_lead(bool leads);
int study_signals_count(void);  /* returns the number of signals since study_signals_catch */
void study_signals_raise(void); /* performs the default action of the last signal */

/* Runs the cases that are not done, and writes table.csv. Failed cases are only counted; the
 * report gets errors that keep the study from continuing. */
bool study_execute(const study_run *run, study_counters *counters, ff_report *report);

/* What a run would do. */
typedef struct study_plan {
    size_t done, failed, left;
    size_t again;       /* number of remaining cases that an earlier run did with other inputs */
    char changed[1000]; /* what differs, in lines such as "duty.torque: 250 N m -> 300 N m" */
    double seconds;     /* estimated time for the remaining cases, s; negative if unknown */
    double spent;       /* time of the done cases on which the estimate is based, s */
    size_t timed;       /* number of cases on whose times the estimate is based */
} study_plan;

/* Adds what a run would do to a plan. A plan starts at {.seconds = -1}. */
void study_preview(const study_run *run, study_plan *plan);

#endif
