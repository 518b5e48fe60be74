/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the cases of a large study that an earlier run has finished. Building a case calls its
   plugins, so this is done in a separate process. If a case crashes that process, later cases are
   not found here; a worker then finds them. */
#ifndef STUDY_FINISHED_CASES_H
#define STUDY_FINISHED_CASES_H

#include "../cases/walk.h"

#include <stdio.h>
#include <sys/types.h>

typedef struct study_known {
    size_t index;
    char key[STUDY_KEY_SIZE];
} study_known;

typedef struct study_search {
    pid_t pid;
    FILE *from;
} study_search;

/* Continues the iteration in a separate process, which closes the two descriptors that plugins must
   not reach. Returns false if the process could not be started. */
bool study_search_start(study_search *search, study_walk *walk, const int hidden[2]);
/* Reads the next finished case. Returns false after the last one. */
bool study_search_next(study_search *search, study_known *known);
void study_search_end(study_search *search);

#endif
