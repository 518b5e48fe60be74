/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A result directory. It is ours when it holds ".flankfilm", which lists the result files in it.
 * All files of a run are written under temporary names, ".flankfilm.<name>.part", then renamed
 * together; files of an earlier run that the new one does not write are removed. The file that was
 * begun last is removed first and gets its name last: a directory of ours without it is of a run
 * that was broken off. Anything else in it is left alone.
 */
#ifndef RESULTS_FOLDER_H
#define RESULTS_FOLDER_H

#include <flankfilm/engine.h>

typedef struct results_folder results_folder;

/* Makes the directory when it is not there and locks it against a second run; `kind` is what it
   holds, "result". NULL, with an error in the report, for a directory of another kind or with files
   of somebody else, one in use or one that cannot be made. */
results_folder *results_folder_open(const char *path, const char *kind, ff_report *report);
void results_folder_free(results_folder *folder);
/* Removes the files that were begun and not committed, then frees the folder. */
void results_folder_discard(results_folder *folder);

/* Forces each file to the disk before it gets its name. */
void results_folder_sync(results_folder *folder);

/* Starts the file <stem><suffix>, both plain words, or <stem>-2<suffix> when that name is taken;
   ends the one before. NULL, with an error in the report, when that fails. */
FILE *results_folder_begin(results_folder *folder, const char *stem, const char *suffix);

/* Ends the last file. False, with an error in the report, when one could not be written. */
bool results_folder_end(results_folder *folder);
/* Removes the result files in a directory of ours, and the directory when nothing else is in it.
   False when it is still there. */
bool results_folder_remove(const char *path);

/* Gives the files their names. False, with an error in the report, when one could not be written:
   then the earlier results are still in place, unless it was a rename that failed. */
bool results_folder_commit(results_folder *folder);

#endif
