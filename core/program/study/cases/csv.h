/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of texts, whose lines the engine splits; the first one that says something is the head. */
#ifndef STUDY_CSV_H
#define STUDY_CSV_H

#include <flankfilm/engine.h>

#include <stdio.h>

enum { STUDY_CSV_FIELDS = 1000 }; /* at most; of more, one is kept */

typedef struct study_csv_field {
    char *text;
    uint32_t column, width; /* in characters */
    bool quoted;
} study_csv_field;

typedef struct study_csv {
    ff_source source;
    uint32_t line;           /* that was read last */
    study_csv_field *fields; /* of that line */
    size_t count;
    const char *fault; /* why the last of them is none, or NULL */
    const char *at;    /* what follows the line */
    bool headed;
    char separator;
    struct ff_field *parts;
    char *texts;
    size_t room;
} study_csv;

/* Reads a file whole. NULL, or why it cannot be read; it is to be closed all the same. */
const char *study_csv_open(study_csv *table, const char *path);
/* Splits the next line that is neither blank nor a remark; false at the end. */
bool study_csv_next(study_csv *table);
void study_csv_close(study_csv *table);

/* Whether a line is blank or a remark. */
bool study_csv_is_silent(const char *line, size_t length);
/* Splits a line from elsewhere; the first one is the head. */
void study_csv_split(study_csv *table, const char *line, size_t length);

/* Parts a head such as "duty.torque [N m]": ends its text behind the name, and returns the unit, ""
   without one. NULL: the brackets are not at its end, or stand alone. */
const char *study_csv_unit(study_csv_field *head);

/* Writes a field, in quotes where it needs them or `always`. */
void study_csv_write(FILE *out, const char *text, size_t length, bool always);

#endif
