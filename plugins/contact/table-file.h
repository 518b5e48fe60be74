/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The history of a contact as text: a header that names the columns, units in brackets, then a row
 * of numbers per instant, separated by commas, semicolons or tabs. Lines that are blank or begin
 * with # are passed over.
 */
#ifndef FF_CONTACT_TABLE_FILE_H
#define FF_CONTACT_TABLE_FILE_H

#include <flankfilm/author.h>

enum {
    FF_COLUMN_TIME,
    FF_COLUMN_RADIUS,
    FF_COLUMN_RADIUS_1,
    FF_COLUMN_RADIUS_2,
    FF_COLUMN_SPEED_1,
    FF_COLUMN_SPEED_2,
    FF_COLUMN_LOAD,
    FF_COLUMN_GAP,
    FF_COLUMNS
};

typedef struct ff_table_file {
    size_t rows;
    double *column[FF_COLUMNS]; /* in SI; NULL: the file has no such column */
    size_t *line;               /* line of the file of each row, from 1 */
} ff_table_file;

/* Reads at least one row. Failures name the parameter `item`, the line and where they can the
   column. The caller frees in any case. */
ff_status ff_table_file_read(const ff_host *host, const char *item, const char *path,
                             ff_table_file *table);
void ff_table_file_free(ff_table_file *table);

const char *ff_table_column(int column);

#endif
