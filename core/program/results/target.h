/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file, or a directory of files, that appears under its name only when it is complete. */
#ifndef RESULTS_TARGET_H
#define RESULTS_TARGET_H

#include "../study/store/journal.h"
#include "folder.h"

typedef struct results_target {
    char *path;             /* owned */
    study_file file;        /* for a file: the stream to write to */
    results_folder *folder; /* for a directory */
    ff_report *report;
    /* An existing file is replaced only if it begins with `begins` and contains `flankfilm`, as the
     * files of the program do. */
    const char *begins;
} results_target;

/* Open `path` as a directory or a file; the caller has set `path` and `report`. They return false
 * after an error. */
bool results_target_open(results_target *target, bool directory);
/* Renames file.part, which was written through file.out or by others, to its final name. */
bool results_target_commit(results_target *target);
/* Removes everything that was not committed. */
void results_target_close(results_target *target);

#endif
