/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An index of the journals of a study: the position of each key's record, in 24 bytes, and the
   forms of the records. A record is read only when it is requested. */
#ifndef STUDY_RECORDS_H
#define STUDY_RECORDS_H

#include "judgement.h"

#include <jansson.h>

enum {
    STUDY_KEY_SIZE = 20,  /* size of a case's key with its terminating zero, bytes */
    STUDY_NAME_SIZE = 64, /* size of the name of a journal or a log with its terminating zero,
                             bytes */
    STUDY_FORMAT = 2      /* of a study's files, stated in study.json */
};

typedef struct study_records study_records;

/* Reads all journals in the directory, which may be missing. If a key has several records, the last
   one with status ok counts, or else the last one. `whole`: records whose arrays are lost are
   ignored. */
study_records *study_records_open(const char *directory, bool whole);
void study_records_close(study_records *records); /* accepts NULL */
/* Closes the journals, so that a worker has no open descriptor of them. A journal is opened again
   for each record that is read later. */
void study_records_close_files(study_records *records);
size_t study_records_count(const study_records *records);

enum study_state { STUDY_UNKNOWN, STUDY_NOT_OK, STUDY_OK };
/* returns the state in a complete line of a journal */
enum study_state study_line_state(const char *line);
enum study_state study_records_state(const study_records *records, const char *key);
/* Returns the record of a key, to be released, or NULL if there is none. */
json_t *study_records_get(study_records *records, const char *key);
/* Returns the next record, to be released, or NULL after the last. *at starts at 0. *rank, which
   may be NULL, increases with the position in the journals. */
json_t *study_records_next(study_records *records, size_t *at, uint64_t *rank);

/* Returns {input: {"stage model": {parameter: value}}} as described in the records. `input` is the
   key of the file, "" if it is unknown. */
const json_t *study_records_described(const study_records *records);

/* Returns the record of a line that was just written, or NULL if it has none. */
json_t *study_records_take(study_records *records, const char *line, size_t length);
/* Stores a record that may not be in the journals yet. */
void study_records_keep(study_records *records, const char *key, json_t *record);

/* Returns the name of the form of a key's record, or "" if it has none or there is no record. */
const char *study_records_form(const study_records *records, const char *key);

/* Judges the record of a key, in most cases without reading it. */
study_judgement study_records_judge(study_records *records, const char *key);

#endif
