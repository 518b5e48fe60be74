/* SPDX-License-Identifier: MIT */
/* Shared by the three files that read tables. */
#ifndef FE_COLUMNS_READ_H
#define FE_COLUMNS_READ_H

#include <flankfilm/engine.h>

enum { FE_MOST_FIELDS = 100, FE_NO_COLUMN = -1 };

/* A table with the places of its parts in the text. */
typedef struct fe_columns {
    ff_table table; /* the part that a model sees; points into the rest */
    ff_source source;
    size_t count; /* number of requested columns */
    const ff_param **requested;
    ff_unit *units; /* units of the requested rows */
    size_t rows;
    double **values; /* by column, in SI; NULL: the file does not have the column */
    uint32_t *lines; /* line number of each row */
    ff_place *heads; /* the place of each column in the header */
    size_t *fields;  /* by column: its field index in a line */
    size_t width;    /* number of fields in a line */
    char separator;  /* separator of the header; ' ': any blanks */
} fe_columns;

/* The state of reading one table. */
typedef struct fe_column_reader {
    fe_columns *c;
    ff_report *report;
    int column_of[FE_MOST_FIELDS]; /* index among the requested columns, or FE_NO_COLUMN */
    ff_unit unit_of[FE_MOST_FIELDS];
    uint32_t line;
    const char *begin; /* of the line being read */
    size_t room, most; /* allocated and largest number of rows */
} fe_column_reader;

/* A field of a line, without surrounding blanks. */
typedef struct fe_field {
    const char *at, *end;
} fe_field;

/* columns-line.c: splits a line into fields. */
fe_field fe_field_trim(const char *at, const char *end);
/* Splits a line into fields. Fields beyond FE_MOST_FIELDS are counted but not stored. */
size_t fe_line_split(fe_field line, char separator, fe_field fields[FE_MOST_FIELDS]);
/* False, with an error, if a field begins with a quote that is not closed. */
bool fe_line_is_closed(const fe_column_reader *reader, size_t count, const fe_field *fields);
/* Splits a line with the separator of the header. If the line does not contain it, uses the first
   separator that gives as many fields as the header has. */
size_t fe_row_split(const fe_columns *columns, fe_field line, fe_field fields[FE_MOST_FIELDS]);
char fe_line_separator(fe_field line); /* Returns the separator of a header. */
/* Returns the place of a part of the current line; if text.at is NULL, of the whole file. */
ff_place fe_column_place(const fe_column_reader *reader, fe_field text);
/* Reports an error at a part of the line. Returns false. */
bool fe_column_refuse(const fe_column_reader *reader, fe_field text, const char *hint,
                      const char *format, ...) __attribute__((format(printf, 4, 5)));

/* columns-head.c: reads the header. */
bool fe_column_heads_read(fe_column_reader *reader, fe_field line);

#endif
