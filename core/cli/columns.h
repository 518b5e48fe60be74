/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A table of numbers in a text file: "pressure [GPa], viscosity [mPa s]" and rows below. Split by
 * semicolons, commas, tabs or blanks, as the header is; lines that begin with # are remarks.
 */
#ifndef FF_COLUMNS_H
#define FF_COLUMNS_H

#include "../plugin/library.h"

typedef struct ff_columns {
    ff_source source;
    size_t count; /* columns that were asked for */
    const ff_param **asked;
    ff_unit *units; /* their rows' */
    size_t rows;
    double **values;  /* in SI, of each of them; NULL: the file lacks it */
    ff_place *places; /* of each number, row by row */
    ff_place *heads;  /* of each column in the header */
} ff_columns;

/* `rows`: what is asked for, see ff_fitter. Everything that is wrong goes to the report; false
   after an error. To be freed either way. */
bool ff_columns_read(ff_columns *columns, const char *path, const ff_param *rows, size_t count,
                     size_t stride, ff_report *report);
void ff_columns_free(ff_columns *columns);

/* A row or column of SIZE_MAX: the file as a whole. */
ff_place ff_columns_place(const ff_columns *columns, size_t row, size_t column);

#endif
