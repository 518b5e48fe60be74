/* SPDX-License-Identifier: MIT */
/*
 * Host extension "flankfilm.table/1": tables of numbers in text files.
 *
 * A model that reads measured data describes the columns by parameter rows. The host reads the file
 * and reports its errors with file, line, column and caret:
 *
 *     static const ff_param columns[] = {
 *         FF_COLUMN("time", "s", FF_REQUIRED | FF_INCREASING, NULL, 0, 0, "of the instant"),
 *         FF_COLUMN("load", "N/mm", FF_REQUIRED, NULL, 0, 1e9, "force over width"),
 *     };
 *     const ff_table *t;
 *     ff_status status = ff_table_read(host, "file", path, FF_TABLE(columns), &t);
 *     if (status != FF_OK)
 *         return status;
 *     for (size_t i = 0; i < t->row_count; i++)
 *         if (t->columns[1][i] > most)
 *             return ff_table_failf(host, t, i, 1, "the load must stay below %g N/m", most);
 *
 * An example of a file:
 *
 *     # twin discs, 2 March; blank lines and lines that begin with # are ignored
 *     time [ms]; load [kN/m]; x-operator
 *     0; 177; Ada
 *     0.5; 180.2; Ada
 *
 * The first line that is neither blank nor a comment is the header. It names the columns, in any
 * order, each with its unit in brackets: any unit with the dimension of its row. A column of a
 * dimensionless row needs no unit. The header decides whether semicolons, commas, tabs or blanks
 * separate the fields; a line without the header's separator may use another one. Numbers are
 * decimal, with a point. Columns whose name begins with "x-" are ignored and free for the user. Any
 * other unknown column is an error, since it may be a misspelt optional column. Files are UTF-8,
 * with or without byte order mark, and regular files; at most 128 MiB, 2000000 rows and 100
 * columns.
 */
#ifndef FLANKFILM_TABLE_H
#define FLANKFILM_TABLE_H

#include "author.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FF_TABLE_ID "flankfilm.table/1"

/* A row of `columns`; flags, group and limits as in ff_param. */
#define FF_COLUMN(name, unit, flags, group, min, max, doc)                                         \
    FF_ROW(name, unit, doc, FF_REALS, flags, NULL, NULL, group, min, max, 0, 0, 0, 0, 0)

/* A table read from a file, valid until the instance is destroyed. */
typedef struct ff_table {
    size_t size;
    size_t row_count;             /* at least 1 */
    const double *const *columns; /* for each column row: row_count finite numbers in coherent
                                     SI, angles in rad; NULL: the file does not have the column */
    const uint32_t *lines;        /* line number of each row in the file, from 1 */
} ff_table;

/* As `row` or `column` of ff_table_fail: all rows or all columns. */
#define FF_TABLE_ALL SIZE_MAX

/*
 * The result of host->extension(host->ctx, FF_TABLE_ID). `ctx` is host->ctx. Call these functions
 * where host->fail is allowed, from create to evaluate, but not in service tables.
 */
typedef struct ff_table_reader {
    size_t size;

    /* Reads the file `path` of the parameter `item`. Returns FF_OK, or a status that the model
       returns unchanged, since the host has reported the error. `rows` describe the columns and
       must be valid as long as the plugin is loaded. Used are: name, unit, doc; type FF_REAL or
       FF_REALS; group; the limits min and max, with FF_MIN_OPEN and FF_MAX_OPEN, for each number;
       FF_WHOLE and FF_INCREASING for the column; min_count and max_count for the number of rows. A
       column with FF_REQUIRED must exist; if it is in a group, one column of the group must exist.
       `preset`, `choices`, `low` and `high` are ignored. */
    ff_status (*read)(void *ctx, const char *item, const char *path, const ff_param *rows,
                      size_t count, size_t stride, const ff_table **table);

    /* Like host->fail with FF_INVALID, with the place of a number of the table. `row` and `column`
       count from 0 in the order of `columns`; FF_TABLE_ALL means all rows or all columns. */
    ff_status (*fail)(void *ctx, const ff_table *table, size_t row, size_t column,
                      const char *text);
} ff_table_reader;

/* Calls `read`; fails if the host does not have the extension. */
FF_UNUSED static ff_status ff_table_read(const ff_host *host, const char *item, const char *path,
                                         const ff_param *rows, size_t count, size_t stride,
                                         const ff_table **table)
{
    const ff_table_reader *reader =
        (const ff_table_reader *)host->extension(host->ctx, FF_TABLE_ID);
    if (!reader)
        return host->fail(host->ctx, FF_UNSUPPORTED, item,
                          "this program cannot read tables for models (" FF_TABLE_ID
                          "); a newer version of it can");
    return reader->read(host->ctx, item, path, rows, count, stride, table);
}

/* Calls `fail` with a printf format. */
FF_UNUSED FF_PRINTF(5, 6) static ff_status
    ff_table_failf(const ff_host *host, const ff_table *table, size_t row, size_t column,
                   const char *format, ...)
{
    const ff_table_reader *reader =
        (const ff_table_reader *)host->extension(host->ctx, FF_TABLE_ID);
    char text[512];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return reader->fail(host->ctx, table, row, column, text);
}

#ifdef __cplusplus
}
#endif
#endif
