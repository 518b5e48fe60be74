/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The files in the directory of a study: the journal with its records, the table, and others. */
#ifndef STUDY_JOURNAL_H
#define STUDY_JOURNAL_H

#include "records.h"

#include <jansson.h>

/* Names of files in a study's directory. */
extern const char study_marker[];      /* marks a directory as that of a study */
extern const char study_description[]; /* written by study_run.describe */

/* Reads a regular file as JSON. Returns NULL if it is not JSON; `error` then has the reason. */
json_t *study_read_json(int directory, const char *name, json_error_t *error);
/* Refuses a directory with files of another format. A directory without a study is accepted. */
bool study_check_format(const char *directory, ff_report *report);

json_t *study_json_real(double value); /* returns null for a number that is not finite */
/* Makes a directory and its parents. Returns true if it already exists. */
bool study_make_path(const char *path);

double study_seconds_now(void);

typedef struct study_journal {
    int fd;
    int directory;              /* descriptor of its locked directory */
    const char *path;           /* path of its directory */
    char name[STUDY_NAME_SIZE]; /* name of its file */
    off_t end;                  /* length of the file after the last write */
    double synced;              /* time when it was last forced to the disk */
    bool lock_file;             /* whether it is locked by a file next to it, since the file
                                   system has no locks */
} study_journal;

/* Prints the name of the journal of a shard. `shard` counts from 1 to `shards`. */
void study_journal_name(size_t shard, size_t shards, char name[STUDY_NAME_SIZE]);
/* Locks the directory and this shard's journal in it, and removes an incomplete last line. */
bool study_journal_open(study_journal *journal, const char *directory, size_t shard, size_t shards,
                        ff_report *report);
/* Appends a line. Refuses if the file has been changed meanwhile: removed, replaced, truncated, or
   written by another process. */
bool study_journal_append(study_journal *journal, const char *line, size_t length,
                          ff_report *report);
/* Forces the journal to the disk, and checks that its file has not been replaced. */
bool study_journal_settle(study_journal *journal, ff_report *report);
void study_journal_close(study_journal *journal);
/* Returns the record as a line with its checksum, to be freed. `written_forms` as in
 * study_form_write. */
char *study_journal_line(json_t *record, json_t *written_forms);
/* Returns whether the line is complete and unchanged. */
bool study_line_is_whole(const char *line, size_t length);
/* Returns the contents of a whole line, to be released, or NULL for any other line. */
json_t *study_line_parse(const char *line, size_t length);

enum study_rerun { STUDY_RERUN_NONE, STUDY_RERUN_FAILED, STUDY_RERUN_ALL };

bool study_record_is_ok(const json_t *record);
/* Returns whether a case with a record of this state need not run again. */
bool study_state_is_settled(enum study_state state, enum study_rerun rerun);

/* file.c: a text file in the study's directory. The file gets its name when it is complete. */
typedef struct study_file {
    FILE *out; /* stream to write to; NULL if it could not be opened, which study_file_end
                  reports */
    char *path, *part;
    int cause; /* errno of the failed opening */
} study_file;

study_file study_file_begin(const char *directory, const char *name); /* NULL: a whole path */
/* False after an error in opening or writing; hint may be NULL. */
bool study_file_end(study_file *file, const char *hint, ff_report *report);
/* Removes a file that has not got its name. */
void study_file_drop(study_file *file);
bool study_write_file(const char *directory, const char *name, const char *text, const char *hint,
                      ff_report *report);
/* Removes unfinished files of a killed run. No other run may be using the directory. */
void study_remove_parts(int directory);

/* lock.c: locks by a file next to the journal, for file systems without locks. The file contains
   the process id, so that a later process can check whether that process has ended. */
bool study_lock_take(study_journal *journal, bool alone, ff_report *report);
void study_lock_drop(const study_journal *journal);

#endif
