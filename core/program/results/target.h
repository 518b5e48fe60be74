/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file, or a directory of files, that appears when all of it is written. */
#ifndef RESULTS_TARGET_H
#define RESULTS_TARGET_H

#include "../study/store/journal.h"
#include "folder.h"

typedef struct results_target {
    char *path;             /* owned */
    study_file file;        /* of a file: where it is written to */
    results_folder *folder; /* of a directory */
    ff_report *report;
    /* A file that is there already is replaced only if it begins with `begins` and has `flankfilm`
       in it, as those that the program writes. */
    const char *begins;
} results_target;

/* Opens `path`, which is set like `report`, as a directory or a file. These return false after an
   error. */
bool results_target_open(results_target *target, bool directory);
/* Gives the name to what was written to file.out, or by others to file.part. */
bool results_target_commit(results_target *target);
/* Removes what was not committed. */
void results_target_close(results_target *target);

#endif
