/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Walks over the cases of a study: each is built in its turn, with its key and the states that it
 * starts from, and is not run. So whoever asks what is known, what is to run, or what a case is
 * called goes the same way.
 */
#ifndef STUDY_WALK_H
#define STUDY_WALK_H

#include "case.h"

#include "../store/records.h"

typedef struct study_walk {
    const study_run *run;
    study_records *records;       /* of earlier runs, and of this one where cases form chains */
    char (*keys)[STUDY_KEY_SIZE]; /* cases with a key there are passed by; NULL: none are */
    size_t end, step;             /* of the chains */

    size_t chain;
    size_t position;             /* in that, of the case that is next */
    char before[STUDY_KEY_SIZE]; /* key of the case before it in its chain; "" for the first */
    json_t *states;              /* {stage: bytes as text} that it starts from */
    study_case c;
    bool open;
    study_kept kept, made; /* for the keys alone, and with the objects of the models */
} study_walk;

/* Walks over the chains of the run's shard, for the keys of their cases alone; the caller may
   change what stands before `position`, and `kept.keys`. */
study_walk study_walk_begin(const study_run *run, study_records *records);
/* Leaves the case before, and returns the next one, open until then; NULL after the last. */
study_case *study_walk_next(study_walk *walk);
/* Goes to a case, which is the next one then; those before it in its chain hand on their states. */
void study_walk_to(study_walk *walk, size_t index);
/* Leaves the open case, which gave that record; NULL: none. */
void study_walk_leave(study_walk *walk, const json_t *record);
/* Builds the open case again with its objects. A case that a model refused as it was made has its
   key from its assignments, which shows then. */
void study_walk_make(study_walk *walk);
void study_walk_end(study_walk *walk);

#endif
