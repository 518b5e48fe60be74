/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A table of stiffness as text: a header that names the columns, units in brackets, then a row of
 * numbers per line, separated by commas, semicolons or tabs. Lines that are blank or begin with #
 * are passed over.
 */
#ifndef FF_STIFFNESS_CSV_H
#define FF_STIFFNESS_CSV_H

#include <flankfilm/author.h>

enum {
    FF_COLUMN_PHASE,
    FF_COLUMN_STIFFNESS,
    FF_COLUMN_ERROR,
    FF_COLUMN_LOADED_ERROR,
    FF_COLUMN_SHARE,
    FF_COLUMNS
};

typedef struct ff_csv {
    size_t rows;
    double *column[FF_COLUMNS]; /* in SI; NULL: the file has no such column */
    size_t *line;               /* line of the file of each row, from 1 */
} ff_csv;

/* Failures name the parameter `item` and the line. The caller frees in any case. */
ff_status ff_csv_read(const ff_host *host, const char *item, const char *path, ff_csv *csv);
void ff_csv_free(ff_csv *csv);

#endif
