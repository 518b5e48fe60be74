/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A line of a table whose fields are parted by semicolons, commas or tabs, and quoted as in RFC
   4180, within the line. */
#ifndef STUDY_CSV_H
#define STUDY_CSV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { STUDY_CSV_FIELDS = 1000 }; /* at most; of more, one is kept */

/* A part of a line, without its quotes and the blanks around it. */
typedef struct study_csv_field {
    char *text;
    uint32_t column, width; /* in characters */
    bool quoted;
} study_csv_field;

typedef struct study_csv_line {
    study_csv_field *fields;
    size_t count;
    const char *fault; /* why it cannot be split, or NULL */
} study_csv_line;

bool study_csv_is_blank(char c);
/* Whether a line is empty or a remark. */
bool study_csv_is_silent(const char *text);
/* The first of the separators that stands outside of quotes; 0: there is none. */
char study_csv_separator(const char *text);
study_csv_line study_csv_split(const char *text, char separator);
void study_csv_free(study_csv_line *line);
/* Writes a field, in quotes where it needs them or `always`. */
void study_csv_write(FILE *out, const char *text, size_t length, bool always);

#endif
