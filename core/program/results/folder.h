/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A result directory. A directory belongs to this program if it contains ".flankfilm", the
 * manifest, which lists the result files. All files of a run are written under temporary names,
 * ".flankfilm.<name>.part", and then renamed together; files of an earlier run that the new one
 * does not write are removed. The file that was begun last is the first to be removed and the last
 * to be renamed: if it is missing, the run was interrupted. All other files in the directory are
 * left alone. */
#ifndef RESULTS_FOLDER_H
#define RESULTS_FOLDER_H

#include <flankfilm/engine.h>

typedef struct results_folder results_folder;

/* Makes the directory if it does not exist, and locks it against other runs. `kind` is the kind of
 * its contents, such as "result". Returns NULL with an error in the report if the directory has
 * another kind or foreign files, is in use, or cannot be made. */
results_folder *results_folder_open(const char *path, const char *kind, ff_report *report);
void results_folder_free(results_folder *folder);
/* Removes the files that were not committed, then frees the folder. */
void results_folder_discard(results_folder *folder);

/* From now on, forces each file to the disk before it is renamed. */
void results_folder_sync(results_folder *folder);

/* Ends the previous file and begins <stem><suffix>, or <stem>-2<suffix> if that name is taken.
 * Returns NULL with an error in the report if that fails. */
FILE *results_folder_begin(results_folder *folder, const char *stem, const char *suffix);

/* Ends the last file. Returns false with an error in the report if any file could not be written.
 */
bool results_folder_end(results_folder *folder);
/* Removes the result files in a directory of this program, and the directory if it is then empty.
 * Returns false if the directory still exists. */
bool results_folder_remove(const char *path);

/* Renames the files to their final names. Returns false with an error in the report if one could
 * not be written; the earlier results are then unchanged, unless the error was in a rename. */
bool results_folder_commit(results_folder *folder);

#endif
