/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The files in the directory of a study: the journal with its records, the table and others. */
#ifndef STUDY_JOURNAL_H
#define STUDY_JOURNAL_H

#include "records.h"

#include <jansson.h>

/* Names of files in a study's directory. */
extern const char study_marker[];      /* its presence makes a directory that of a study */
extern const char study_description[]; /* written by study_run.describe */

/* Reads a regular file as JSON. NULL: it is none, and `error` has the text. */
json_t *study_read_json(int directory, const char *name, json_error_t *error);
/* Refuses a directory whose files are of another format; one without a study is good. */
bool study_check_format(const char *directory, ff_report *report);

json_t *study_json_real(double value); /* null for a number that is not finite */
/* Makes a directory and those above it; true when it exists already. */
bool study_make_path(const char *path);

double study_seconds_now(void);

typedef struct study_journal {
    int fd;
    int directory;              /* descriptor of its directory, which is locked */
    const char *path;           /* of its directory */
    char name[STUDY_NAME_SIZE]; /* of its file */
    off_t end;                  /* how long the file was left */
    double synced;              /* when it was last forced to the disk */
    bool lock_file; /* it is locked by a file beside it, since the file system has no locks */
} study_journal;

/* Prints the name of the journal of a shard, from 1 to `shards`. */
void study_journal_name(size_t shard, size_t shards, char name[STUDY_NAME_SIZE]);
/* Locks the directory and this shard's journal in it, and drops an unfinished last line. */
bool study_journal_open(study_journal *journal, const char *directory, size_t shard, size_t shards,
                        ff_report *report);
/* Refuses to write when the file is not the one that was left: removed, replaced, cut short, or
   written to by another process. */
bool study_journal_append(study_journal *journal, const char *line, size_t length,
                          ff_report *report);
/* Forces the journal to the disk, and checks that its file is the one that was left. */
bool study_journal_settle(study_journal *journal, ff_report *report);
void study_journal_close(study_journal *journal);
/* Returns the record as a line with its checksum, to be freed; `said` as in study_form_write. */
char *study_journal_line(json_t *record, json_t *said);
/* Whether the line is complete and was not changed. */
bool study_line_is_whole(const char *line, size_t length);
/* Returns what such a line says, to be released; NULL for another one. */
json_t *study_line_parse(const char *line, size_t length);

enum study_rerun { STUDY_RERUN_NONE, STUDY_RERUN_FAILED, STUDY_RERUN_ALL };

bool study_record_is_ok(const json_t *record);
/* Whether a run would not repeat a case with such a record. */
bool study_state_is_settled(enum study_state state, enum study_rerun rerun);

/* file.c: a text file in the study's directory, which has its name once it is whole. */
typedef struct study_file {
    FILE *out; /* to write to; NULL where it could not be made, which the end says */
    char *path, *part;
    int cause; /* errno of that */
} study_file;

study_file study_file_begin(const char *directory, const char *name);
/* False after an error of this or of writing; hint may be NULL. */
bool study_file_end(study_file *file, const char *hint, ff_report *report);
bool study_write_file(const char *directory, const char *name, const char *text, const char *hint,
                      ff_report *report);
/* Removes what a run that was killed had begun to write there; no other run may use the directory.
 */
void study_remove_parts(int directory);

/* lock.c: locks by a file beside the journal, where the file system has no locks. The file names
   the process, whose end the next one notices. */
bool study_lock_take(study_journal *journal, bool alone, ff_report *report);
void study_lock_drop(const study_journal *journal);

#endif
