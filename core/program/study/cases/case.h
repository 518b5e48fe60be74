/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A case is the pipeline of the file with the case's assignments. These functions build, run and
   record a case. */
#ifndef STUDY_CASE_H
#define STUDY_CASE_H

#include "study.h"

#include "../../accuracy/measure.h"
#include "../../arrays/log.h"
#include "../store/records.h"
#include "../store/reuse.h"

#include <jansson.h>

/* arrays.c */
typedef struct study_shared {   /* memory that a worker shares with the process that started it */
    char key[STUDY_KEY_SIZE];   /* key of the case that is running */
    unsigned log;               /* number of the worker's log under an executor; 0: it has none */
    char name[STUDY_NAME_SIZE]; /* name of the log */
    off_t end;                  /* end of the log after the last case that was stored */
    ff_guard_mirror running;    /* plugin whose code is running in the worker */
} study_shared;

typedef struct study_arrays { /* where a worker stores arrays */
    const study_run *run;
    study_shared *shared;
    size_t slot;    /* number of the worker */
    arrays_log log; /* open only while the arrays of a case are written, so that no plugin can use
                       its descriptor */
} study_arrays;

/* arrays.c: appends the requested arrays of a case to the log, and writes their places to the
   record. The pool forces them to the disk. Returns false with an error in c->report. */
struct study_case;
bool study_arrays_keep(study_arrays *arrays, const struct study_case *c, json_t *record);

/* case.c */
/* The run of the last case. The next case reuses it if they differ only in plain values. Starts
   zeroed. */
typedef struct study_kept {
    ff_run *run;    /* NULL: there is none */
    size_t index;   /* index of the last case */
    size_t changes; /* number of changes since it was built; each change takes memory */
    bool keys;      /* true: only keys of cases are needed, so no objects are made */
} study_kept;

void study_kept_free(study_kept *kept);

typedef struct study_memory { /* what a worker keeps between cases */
    int directory;            /* descriptor of the folder with stored results of stages; -1: none */
    study_reuse_stats *stats;
    study_arrays arrays;
    json_t *seen; /* {stage, model and build: true} for the setups already described in records
                     of this worker */
    json_t *written_forms; /* forms already written in its records */
} study_memory;

typedef struct study_case {
    study_kept *kept; /* where its run is stored when it is closed; NULL: nowhere */
    size_t index;
    ff_run *run;
    ff_report *report;     /* messages of the run */
    ff_pipeline *pipeline; /* pipeline of the run; may be NULL after errors */
    uint64_t *fingerprints;
    char key[STUDY_KEY_SIZE];
    const json_t *states; /* {stage: state} from which the case starts; NULL if it is in no chain */
    char from[20];        /* hash of those states */
} study_case;

/* Reads the file of a study as the base of its cases. Returns NULL if there is any message about
   it; each case then reports it. */
ff_run *study_case_base(ff_engine *engine, const char *file);
/* `kept` may be NULL. */
void study_case_open(study_case *c, const study_run *run, size_t index, study_kept *kept);
void study_case_close(study_case *c);
/* Runs the case. Returns NULL, with an error in c->report, if its arrays could not be stored. */
json_t *study_case_run(study_case *c, const study_run *run, size_t index, study_memory *memory);

/* case-record.c */
json_t *study_case_set(const study_definition *study, size_t index); /* {path: value} */
/* returns whether the case can be run */
bool study_case_is_good(const study_case *c);
/* Returns whether a row of a spectrum cannot be computed, and the only reason is that its numbers
   are beyond limits. */
bool study_case_is_refused(const study_definition *study, const ff_report *report);
/* Returns a record without outputs or judgement. `reason` may be NULL. */
json_t *study_case_record(const study_run *run, size_t index, const char *key, const char *status,
                          const char *reason);
/* Returns the record of a case that has run and whose errors were measured. Returns NULL, with an
   error in c->report, if its arrays could not be stored. */
json_t *study_case_record_run(study_case *c, const study_run *run, size_t index, json_t *warnings,
                              const accuracy_record *errors, study_memory *memory);
/* returns seconds rounded to microseconds, the resolution of the clocks */
json_t *study_json_seconds(double seconds);
/* Returns the text of the first error, to be freed. If the error is in a table, its place is added,
   since the text does not contain it. */
char *study_first_error(const ff_report *report);

/* overlay.c */
/* Returns assignment i of a case: first its files, then `sets`, then its values. Returns NULL after
   the last one, and "" if there is nothing to assign. */
const char *study_case_assignment(const study_definition *study, size_t index,
                                  const char *const *sets, size_t set_count, size_t i);
/* Returns whether an assignment includes a file. */
bool study_names_file(const char *assignment);

/* stage-description.c */
/* Returns {stage: {parameter: value}} for all stages if `seen` lacks one of their models, otherwise
   {}. */
json_t *study_case_parameters(const study_case *c, json_t *seen);
/* Prints in which settings the case differs from the description, apart from the values that the
   study varies. */
void study_setup_compare(const study_case *c, const study_definition *study,
                         const json_t *described, FILE *out);
/* Warns of each plugin whose build differs from that in the records. */
void study_setup_warn_rebuilt(const study_run *run, const study_records *records,
                              ff_report *report);

/* measure.c */
/* Returns the fingerprint of a repeat. The key of the repeat is made from it. */
uint64_t study_measure_fingerprint(uint64_t fingerprint, size_t repeat);
/* Binds this process to the core on which it runs. */
void study_measure_pin(void);
/* Makes stages compute the outputs that are to be measured, and leave out estimates in twins. */
void study_measure_want(const study_definition *study, size_t index, const ff_pipeline *pipeline);
/* Returns, for each stage, whether it is evaluated in every case. To be freed. */
bool *study_measure_fresh(const study_measure *measure, const ff_pipeline *pipeline);
/* Adds the measured costs and axes to the record. */
void study_measure_record(const study_case *c, const study_definition *study, json_t *record);

#endif
