/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One case is the file with its assignments, which is built, run and recorded. */
#ifndef STUDY_CASE_H
#define STUDY_CASE_H

#include "study.h"

#include "../../accuracy/measure.h"
#include "../../arrays/log.h"
#include "../store/records.h"
#include "../store/reuse.h"

#include <jansson.h>

/* arrays.c */
typedef struct study_shared {   /* by a worker with the process that started it */
    char key[STUDY_KEY_SIZE];   /* of the case that it runs */
    unsigned log;               /* number of its log under an executor; 0: it has none */
    char name[STUDY_NAME_SIZE]; /* of its log */
    off_t end;                  /* of its log, after the last case that was kept */
    ff_guard_mirror running;    /* whose code runs there */
} study_shared;

typedef struct study_arrays { /* where a worker keeps arrays */
    const study_run *run;
    study_shared *shared;
    size_t slot; /* number of the worker */
    arrays_log
        log; /* open while the arrays of a case are written: no plugin meets its descriptor */
} study_arrays;

/* Appends the requested arrays of a case to the log and adds to the record where they are; the pool
   forces them to the disk. False with an error in c->report. */
struct study_case;
bool study_arrays_keep(study_arrays *arrays, const struct study_case *c, json_t *record);

/* case.c */
/* The run of the last case, which the next one goes on with where they differ in plain values.
   Starts zeroed. */
typedef struct study_kept {
    ff_run *run;    /* NULL: there is none */
    size_t index;   /* of that case */
    size_t changes; /* since it was built: its memory grows by each */
    bool keys;      /* set by who asks for the keys of cases alone: no objects are made */
} study_kept;

void study_kept_free(study_kept *kept);

typedef struct study_memory { /* what a worker keeps from case to case */
    int directory; /* descriptor of the directory with results of stages; -1 when none is kept */
    study_reuse_stats *stats;
    study_arrays arrays;
    json_t *seen; /* {stage, model and build: true} of the setups that a record of this worker
                     describes */
    json_t *said; /* the forms that its records have said */
} study_memory;

typedef struct study_case {
    study_kept *kept; /* where its run goes when it is closed; NULL: nowhere */
    size_t index;
    ff_run *run;
    ff_report *report;     /* its messages */
    ff_pipeline *pipeline; /* of it; may be NULL after errors */
    uint64_t *fingerprints;
    char key[STUDY_KEY_SIZE];
    const json_t *states; /* {stage: state} that it starts from; NULL when it is not in a chain */
    char from[20];        /* hash of those states */
} study_case;

/* Reads the file of a study for its cases; NULL when there is anything to say of it, which is said
   of each case then. */
ff_run *study_case_base(ff_engine *engine, const char *file);
/* `kept` may be NULL. */
void study_case_open(study_case *c, const study_run *run, size_t index, study_kept *kept);
void study_case_close(study_case *c);
/* Runs the case; NULL, with an error in c->report, when its arrays could not be kept. */
json_t *study_case_run(study_case *c, const study_run *run, size_t index, study_memory *memory);

/* case-record.c */
json_t *study_case_set(const study_definition *study, size_t index); /* {path: value} */
bool study_case_is_good(const study_case *c);                        /* whether it can be run */
/* Whether a row of a spectrum cannot be computed, since its numbers are beyond limits, and nothing
   else is wrong with it. */
bool study_case_is_refused(const study_definition *study, const ff_report *report);
/* Returns a record without outputs and judgement; reason may be NULL. */
json_t *study_case_record(const study_run *run, size_t index, const char *key, const char *status,
                          const char *reason);
/* Returns the record of a case that has run, whose errors were measured; NULL, with an error in
   c->report, when its arrays could not be kept. */
json_t *study_case_record_run(study_case *c, const study_run *run, size_t index, json_t *warnings,
                              const accuracy_record *errors, study_memory *memory);
json_t *study_json_seconds(double seconds); /* to the microsecond, as exact as any clock here is */
/* Returns the text of the first error, to be freed; with its place when that is in a table, which
   the text does not name. */
char *study_first_error(const ff_report *report);

/* overlay.c */
/* Returns assignment i of a case: its files, then `sets`, then its values. NULL after the last; ""
   where there is nothing to assign. */
const char *study_case_assignment(const study_definition *study, size_t index,
                                  const char *const *sets, size_t set_count, size_t i);
/* Whether an assignment includes a file. */
bool study_names_file(const char *assignment);

/* setup.c */
/* {stage: {parameter: value}} of all stages, when one of them has a model that `seen` does not hold
   yet; else {}. */
json_t *study_case_parameters(const study_case *c, json_t *seen);
/* Prints how the case differs from what was described, in ways that the study does not vary. */
void study_setup_compare(const study_case *c, const study_definition *study,
                         const json_t *described, FILE *out);
/* Warns of each plugin that is another build than those of the records. */
void study_setup_warn_rebuilt(const study_run *run, const study_records *records,
                              ff_report *report);

/* measure.c */
/* Returns the fingerprint of a repeat, from which its key is made. */
uint64_t study_measure_fingerprint(uint64_t fingerprint, size_t repeat);
/* Binds this process to the core that it runs on. */
void study_measure_pin(void);
/* Makes stages compute what the measure records of them. */
void study_measure_want(const study_definition *study, const ff_pipeline *pipeline);
/* Returns for each stage whether it is evaluated in every case; to be freed. */
bool *study_measure_fresh(const study_measure *measure, const ff_pipeline *pipeline);
/* Adds what was measured to the record. */
void study_measure_record(const study_case *c, const study_definition *study, json_t *record);

#endif
