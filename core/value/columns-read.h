/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of the reader of tables alone. */
#ifndef FF_COLUMNS_READ_H
#define FF_COLUMNS_READ_H

#include "columns.h"

enum { FF_MOST_FIELDS = 100, FF_NO_COLUMN = -1 };

/* Where the reading stands. */
typedef struct ff_column_reader {
    ff_columns *c;
    ff_report *report;
    int column_of[FF_MOST_FIELDS]; /* rank of the column that was asked for, or FF_NO_COLUMN */
    ff_unit unit_of[FF_MOST_FIELDS];
    uint32_t line;
    const char *begin; /* of the line */
    size_t room, most; /* of rows */
} ff_column_reader;

/* A field of a line, without the blanks around it. */
typedef struct ff_field {
    const char *at, *end;
} ff_field;

/* columns-line.c: a line and its fields. */
ff_field ff_field_trim(const char *at, const char *end);
/* Cuts a line into fields; more than FF_MOST_FIELDS are counted, but not kept. */
size_t ff_line_split(ff_field line, char separator, ff_field fields[FF_MOST_FIELDS]);
/* As the header is split; a line without its separator in the first way that gives as many fields
   as the header has. */
size_t ff_row_split(const ff_columns *columns, ff_field line, ff_field fields[FF_MOST_FIELDS]);
char ff_line_separator(ff_field line); /* of a header */
/* Of a stretch of the line that is read; at NULL: of the whole file. */
ff_place ff_column_place(const ff_column_reader *reader, ff_field text);
/* An error at a stretch of the line. Returns false. */
bool ff_column_refuse(const ff_column_reader *reader, ff_field text, const char *hint,
                      const char *format, ...) __attribute__((format(printf, 4, 5)));

/* columns-head.c: what the header says. */
bool ff_column_heads_read(ff_column_reader *reader, ff_field line);

#endif
