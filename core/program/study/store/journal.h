/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The files in the directory of a study: the journal with its records, the table, and others. */
#ifndef STUDY_JOURNAL_H
#define STUDY_JOURNAL_H

#include "records.h"

#include <jansson.h>

/* Names of files in a study's directory. */
extern const char study_marker[];      /* marks a directory as that of a study */
extern const char study_description[]; /* written by study_run.describe */

/* Reads a regular file as JSON. NULL: it is not JSON, and `error` says why. */
json_t *study_read_json(int directory, const char *name, json_error_t *error);
/* Refuses a directory with files of another format. A directory without a study is good. */
bool study_check_format(const char *directory, ff_report *report);

json_t *study_json_real(double value); /* null for a number that is not finite */
/* Makes a directory and those above it; true if it exists already. */
bool study_make_path(const char *path);

double study_seconds_now(void);

typedef struct study_journal {
    int fd;
    int directory;              /* descriptor of its locked directory */
    const char *path;           /* of its directory */
    char name[STUDY_NAME_SIZE]; /* of its file */
    off_t end;                  /* length of the file after the last write */
    double synced;              /* time when it was last forced to the disk */
    bool lock_file;             /* locked by a file beside it, since the file system has no locks */
} study_journal;

/* Prints the name of the journal of a shard, which counts from 1 to `shards`. */
void study_journal_name(size_t shard, size_t shards, char name[STUDY_NAME_SIZE]);
/* Locks the directory and this shard's journal in it, and drops an incomplete last line. */
bool study_journal_open(study_journal *journal, const char *directory, size_t shard, size_t shards,
                        ff_report *report);
/* Appends a line. Refuses if the file has been changed since: removed, replaced, truncated, or
 * written by another process. */
bool study_journal_append(study_journal *journal, const char *line, size_t length,
                          ff_report *report);
/* Forces the journal to the disk, and checks that its file has not been replaced. */
bool study_journal_settle(study_journal *journal, ff_report *report);
void study_journal_close(study_journal *journal);
/* Returns the record as a line with its checksum, to be freed; `said` as in study_form_write. */
char *study_journal_line(json_t *record, json_t *said);
/* Whether the line is complete and unchanged. */
bool study_line_is_whole(const char *line, size_t length);
/* Returns the contents of such a line, to be released; NULL for any other line. */
json_t *study_line_parse(const char *line, size_t length);

enum study_rerun { STUDY_RERUN_NONE, STUDY_RERUN_FAILED, STUDY_RERUN_ALL };

bool study_record_is_ok(const json_t *record);
/* Whether a case with a record of this state is not to be run again. */
bool study_state_is_settled(enum study_state state, enum study_rerun rerun);

/* file.c: a text file in the study's directory, which gets its name once it is complete. */
typedef struct study_file {
    FILE *out; /* to write to; NULL if it could not be made, which study_file_end reports */
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
/* Removes files that a killed run has left unfinished. No other run may be using the directory. */
void study_remove_parts(int directory);

/* lock.c: locks by a file beside the journal, for file systems without locks. The file names its
 * process, so that the next one can tell whether it has ended. */
bool study_lock_take(study_journal *journal, bool alone, ff_report *report);
void study_lock_drop(const study_journal *journal);

#endif
