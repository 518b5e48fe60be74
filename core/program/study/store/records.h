/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the journals of a study hold: where the record of each key is, in 24 bytes, and the forms of
 * the records. A record is read when it is asked for.
 */
#ifndef STUDY_RECORDS_H
#define STUDY_RECORDS_H

#include "judgement.h"

#include <jansson.h>

enum {
    STUDY_KEY_SIZE = 20,  /* bytes of the key of a case, with its end */
    STUDY_NAME_SIZE = 64, /* bytes of the name of a journal or a log */
    STUDY_FORMAT = 2      /* of the files of a study, which study.json tells */
};

typedef struct study_records study_records;

/* Reads all journals in the directory, which may be missing. A key has its last record that is ok,
   else its last one. `whole`: without records whose arrays are lost. */
study_records *study_records_open(const char *directory, bool whole);
void study_records_close(study_records *records); /* accepts NULL */
/* Closes the journals, which are opened anew for each record that is read from now on: so a worker
   holds no descriptor of them. */
void study_records_let_go(study_records *records);
size_t study_records_count(const study_records *records);

enum study_state { STUDY_UNKNOWN, STUDY_NOT_OK, STUDY_OK };
enum study_state study_line_state(const char *line); /* of a whole line of a journal */
enum study_state study_records_state(const study_records *records, const char *key);
/* Returns the record of a key, to be released; NULL when there is none. */
json_t *study_records_get(study_records *records, const char *key);
/* Returns the next record, to be released; *at starts at 0. NULL after the last. Of two records the
   one of the higher rank, which may be NULL, is further behind in the journals. */
json_t *study_records_next(study_records *records, size_t *at, uint64_t *rank);

/* {input: {"stage model": {parameter: value}}} as the records describe them; the input is the key
   of the file, "" where it is not told. */
const json_t *study_records_described(const study_records *records);

/* Returns the record of a line that was just written; NULL when it is none. */
json_t *study_records_take(study_records *records, const char *line, size_t length);
/* Keeps a record that the journals may not have yet. */
void study_records_keep(study_records *records, const char *key, json_t *record);

/* Names the form of a key's record; "" when it has none, or there is no record. */
const char *study_records_form(const study_records *records, const char *key);

/* Judges the record of a key, mostly without reading it. */
study_judgement study_records_judge(study_records *records, const char *key);

#endif
