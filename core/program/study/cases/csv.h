/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads tables of texts. The engine splits their lines. The first line that is neither blank nor a
   comment is the head. */
#ifndef STUDY_CSV_H
#define STUDY_CSV_H

#include <flankfilm/engine.h>

#include <stdio.h>

/* Largest number of fields; one more is stored to detect a longer line. */
enum { STUDY_CSV_FIELDS = 1000 };

typedef struct study_csv_field {
    char *text;
    uint32_t column, width; /* position and width in characters */
    bool quoted;
} study_csv_field;

typedef struct study_csv {
    ff_source source;
    uint32_t line;           /* number of the current line */
    study_csv_field *fields; /* fields of the current line */
    size_t count;
    const char *fault; /* why the last field is invalid, or NULL */
    const char *at;    /* the text after the line */
    bool headed;
    char separator;
    struct ff_field *parts;
    char *texts;
    size_t room;
} study_csv;

/* Reads a whole file. Returns NULL, or the reason why it cannot be read. The table must be closed
   in either case. */
const char *study_csv_open(study_csv *table, const char *path);
/* Splits the next line that is neither blank nor a comment. Returns false at the end. */
bool study_csv_next(study_csv *table);
void study_csv_close(study_csv *table);

/* Returns whether a line is blank or a comment. */
bool study_csv_is_silent(const char *line, size_t length);
/* Splits a line from another source. The first one is the head. */
void study_csv_split(study_csv *table, const char *line, size_t length);

/* Splits a head such as "duty.torque [N m]": ends its text after the name, and returns the unit, ""
   if there is none. Returns NULL if the brackets are not at its end, or if there is no name. */
const char *study_csv_unit(study_csv_field *head);

/* Writes a field, in quotes if it needs them or `always` is set. */
void study_csv_write(FILE *out, const char *text, size_t length, bool always);

#endif
