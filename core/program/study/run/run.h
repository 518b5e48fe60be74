/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs the cases of a study, and tells what a run would do. */
#ifndef STUDY_RUN_H
#define STUDY_RUN_H

#include "../cases/study.h"

#include <signal.h>

/* What reusing kept results of stages has saved. */
typedef struct study_reuse_counts {
    size_t computed, reused; /* numbers of stages */
    double spent, saved; /* s that the computed stages took, and that the reused ones took when they
                            were computed */
} study_reuse_counts;

/* Sums over all cases in the directory; zero when there is no study in it. */
study_reuse_counts study_savings(const char *directory);

typedef struct study_counters {
    bool leads;    /* this process keeps the counters, not another one of the executor */
    size_t total;  /* cases of this shard */
    size_t before; /* cases of those that an earlier run has done */
    size_t done;   /* cases done, including those */
    size_t failed; /* cases of those done that failed */
    double seconds;
    study_reuse_counts savings; /* of the cases done in this run */
    study_tally tally;          /* of the cases done; to be freed by study_tally_free */
} study_counters;

/* Adds what the stages of a case have cost and saved; record may be NULL. */
void study_savings_add(study_reuse_counts *savings, const json_t *record);

/* recount.c: counts the cases of this run that have a key by their rows on the disk, in place of
   what the counters hold. Reports the cases whose rows are lost. */
bool study_recount(const study_run *run, study_records *records, char (*keys)[STUDY_KEY_SIZE],
                   study_counters *counters, ff_report *report);

/* signals.c: what SIGINT and SIGTERM did before. */
typedef struct study_signals {
    struct sigaction interrupt, terminate;
} study_signals;

/* From here on the first of these signals lets the cases at hand finish, also between the rounds of
   a driver, which runs several lots of cases; the second ends at once. */
void study_signals_catch(study_signals *before);
void study_signals_restore(const study_signals *before);
/* Whether this process ends the workers itself, and tells the user of the first signal. */
void study_signals_lead(bool leads);
int study_signals_count(void);  /* since they were caught */
void study_signals_raise(void); /* does what the last one did by default */

/* Runs what is not done yet, then writes table.csv. Failed cases are only counted; the report gets
   what keeps the study from going on. */
bool study_execute(const study_run *run, study_counters *counters, ff_report *report);

/* What a run would do. */
typedef struct study_plan {
    size_t done, failed, left;
    size_t again;       /* cases of those left that an earlier run has done with other inputs */
    char changed[1000]; /* what differs: lines such as "duty.torque: 250 N m -> 300 N m" */
    double seconds;     /* s that the cases left will take, estimated from those done; negative when
                           unknown */
    double spent;       /* s of so many cases done, which that rests on */
    size_t timed;
} study_plan;

/* Adds what a run would do; a plan begins at {.seconds = -1}. */
void study_preview(const study_run *run, study_plan *plan);

#endif
