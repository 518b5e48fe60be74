/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Finds the cases of a large study that an earlier run has done, in a process of its own: building
 * a case calls its plugins. A case after one that crashes it is not found, and a worker sees to it.
 */
#ifndef STUDY_KNOWN_H
#define STUDY_KNOWN_H

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

/* Goes on with the walk in a process of its own, which closes the two descriptors that are hidden
   from plugins. False: no process could be started. */
bool study_search_start(study_search *search, study_walk *walk, const int hidden[2]);
/* Returns whether there is one more. */
bool study_search_next(study_search *search, study_known *known);
void study_search_end(study_search *search);

#endif
