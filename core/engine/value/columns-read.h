/* SPDX-License-Identifier: MIT */
/* What the three files of the reader of tables share. */
#ifndef FE_COLUMNS_READ_H
#define FE_COLUMNS_READ_H

#include <flankfilm/engine.h>

enum { FE_MOST_FIELDS = 100, FE_NO_COLUMN = -1 };

/* A table, and where in which text it stands. */
typedef struct fe_columns {
    ff_table table; /* the view of a model, which points to the rest */
    ff_source source;
    size_t count; /* columns that were asked for */
    const ff_param **asked;
    ff_unit *units; /* their rows' */
    size_t rows;
    double **values; /* in SI, of each column; NULL: the file lacks it */
    uint32_t *lines; /* of each row */
    ff_place *heads; /* of each column in the header */
    size_t *fields;  /* of each column: which field of a line */
    size_t width;    /* fields of a line */
    char separator;  /* of the header; ' ': any blanks */
} fe_columns;

/* The state of reading one table. */
typedef struct fe_column_reader {
    fe_columns *c;
    ff_report *report;
    int column_of[FE_MOST_FIELDS]; /* rank of the column that was asked for, or FE_NO_COLUMN */
    ff_unit unit_of[FE_MOST_FIELDS];
    uint32_t line;
    const char *begin; /* of the line */
    size_t room, most; /* of rows */
} fe_column_reader;

/* A field of a line, without the blanks around it. */
typedef struct fe_field {
    const char *at, *end;
} fe_field;

/* columns-line.c: a line and its fields. */
fe_field fe_field_trim(const char *at, const char *end);
/* Splits a line into fields; those beyond FE_MOST_FIELDS are counted, but not kept. */
size_t fe_line_split(fe_field line, char separator, fe_field fields[FE_MOST_FIELDS]);
/* False after an error: a field among these begins with a quote that does not end it. */
bool fe_line_is_closed(const fe_column_reader *reader, size_t count, const fe_field *fields);
/* Splits a line as the header was split. Without that separator in it, the first one that gives as
   many fields as the header has is used. */
size_t fe_row_split(const fe_columns *columns, fe_field line, fe_field fields[FE_MOST_FIELDS]);
char fe_line_separator(fe_field line); /* of a header */
/* The place of a part of the line that is being read; at NULL: of the whole file. */
ff_place fe_column_place(const fe_column_reader *reader, fe_field text);
/* Reports an error at a part of the line. Returns false. */
bool fe_column_refuse(const fe_column_reader *reader, fe_field text, const char *hint,
                      const char *format, ...) __attribute__((format(printf, 4, 5)));

/* columns-head.c: reads the header. */
bool fe_column_heads_read(fe_column_reader *reader, fe_field line);

#endif
