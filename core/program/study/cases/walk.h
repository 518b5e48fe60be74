/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Iterates over the cases of a study: builds each case with its key and initial states, without
   running it. The search for finished cases, the plan and the run all use this order. */
#ifndef STUDY_WALK_H
#define STUDY_WALK_H

#include "case.h"

#include "../store/records.h"

typedef struct study_walk {
    const study_run *run;
    study_records *records;       /* records of earlier runs, and of this run if cases form
                                     chains */
    char (*keys)[STUDY_KEY_SIZE]; /* cases that have a key here are skipped; NULL: no case is
                                     skipped */
    size_t end, step;             /* end and step of the chain numbers */

    size_t chain;
    size_t position;             /* position of the next case in its chain */
    char before[STUDY_KEY_SIZE]; /* key of the previous case in the chain; "" for the first */
    json_t *states;              /* {stage: bytes as text} from which the case starts */
    study_case c;
    bool open;
    study_kept kept, made; /* runs built only for their keys, and runs built with model objects */
} study_walk;

/* Begins an iteration over the chains of the run's shard that only finds keys. The caller may
   change the members before `position`, and `kept.keys`. */
study_walk study_walk_begin(const study_run *run, study_records *records);
/* Leaves the open case and opens the next one. Returns NULL after the last. */
study_case *study_walk_next(study_walk *walk);
/* Makes a case the next one. Earlier cases of its chain pass on their states. */
void study_walk_to(study_walk *walk, size_t index);
/* Leaves the open case with the record that it gave, or NULL if it gave none. */
void study_walk_leave(study_walk *walk, const json_t *record);
/* Builds the open case again with its model objects. If a model refuses the case, the key is made
   from the assignments. */
void study_walk_make(study_walk *walk);
void study_walk_end(study_walk *walk);

#endif
