/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a table of numbers from a text file; flankfilm/table.h describes the format. */
#ifndef FE_COLUMNS_H
#define FE_COLUMNS_H

#include "report.h"
#include "unit.h"

#include <flankfilm/table.h>

typedef struct fe_columns {
    ff_table table; /* the view of a model */
    fe_source source;
    size_t count; /* columns that were asked for */
    const ff_param **asked;
    fe_unit *units; /* their rows' */
    size_t rows;
    double **values; /* in SI, of each column; NULL: the file lacks it */
    uint32_t *lines; /* of each row */
    fe_place *heads; /* of each column in the header */
    size_t *fields;  /* of each column: which field of a line */
    size_t width;    /* fields of a line */
    char separator;  /* of the header; ' ': any blanks */
} fe_columns;

/* Reports everything that is wrong, up to 20 errors; false after one. The columns must be freed
   either way. */
bool fe_columns_read(fe_columns *columns, const char *path, const ff_param *rows, size_t count,
                     size_t stride, fe_report *report);
void fe_columns_free(fe_columns *columns);

/* The place of a field; a row or column of SIZE_MAX stands for all of them. */
fe_place fe_columns_place(const fe_columns *columns, size_t row, size_t column);

#endif
