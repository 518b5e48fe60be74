/* SPDX-License-Identifier: MIT */
/*
 * Host extension "flankfilm.table/1": tables of numbers in text files.
 *
 * A model that reads measured data states the columns that it wants as rows of parameters; the
 * host reads the file and says what is wrong with it, with file, line, column and caret:
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
 * What a file may look like:
 *
 *     # twin discs, 2 March; blank lines and lines that begin with # are passed over
 *     time [ms]; load [kN/m]; x-operator
 *     0; 177; Ada
 *     0.5; 180.2; Ada
 *
 * The first line that says something names the columns, in any order, each with its unit in
 * brackets: any unit of the dimension of its row. A column of a dimensionless row needs none.
 * Fields are parted by semicolons, commas, tabs or blanks, as the header is; a row without the
 * separator of the header may use another. Numbers are decimal, with a point. Columns whose name
 * begins with "x-" are the user's own; any other that no row names is refused, since it may be an
 * optional one that was mistyped. UTF-8, with or without byte order mark; at most 128 MiB,
 * 2000000 rows and 100 columns; regular files alone.
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

/* A table that was read. It lives until the instance is destroyed. */
typedef struct ff_table {
    size_t size;
    size_t row_count;             /* at least 1 */
    const double *const *columns; /* of each column asked for: row_count finite numbers in coherent
                                     SI, angles in rad; NULL: the file lacks it */
    const uint32_t *lines;        /* of each row in the file, from 1 */
} ff_table;

/* Stands for the whole table as a row, for all columns as a column. */
#define FF_TABLE_ALL SIZE_MAX

/*
 * What host->extension(host->ctx, FF_TABLE_ID) gives. `ctx` is host->ctx; call from where
 * host->fail may be called, create to evaluate, but not from service tables.
 */
typedef struct ff_table_reader {
    size_t size;

    /* Reads the file `path` of the parameter `item`. FF_OK, or a status for the model to return as
       it is: the host has said why. `rows` state the columns and live as long as the plugin: name,
       unit, doc; type FF_REAL or FF_REALS; group; the limits min and max, with FF_MIN_OPEN and
       FF_MAX_OPEN, for each number; FF_WHOLE and FF_INCREASING for the column; min_count and
       max_count for the number of rows. A column with FF_REQUIRED must be there; in a group, one
       of its columns must. `preset`, `choices`, `low` and `high` have no meaning here. */
    ff_status (*read)(void *ctx, const char *item, const char *path, const ff_param *rows,
                      size_t count, size_t stride, const ff_table **table);

    /* As host->fail, with FF_INVALID, about the number in a row and column of the table, both from
       0 in the order of `columns`, or about all of a row, of a column or of the table. */
    ff_status (*fail)(void *ctx, const ff_table *table, size_t row, size_t column,
                      const char *text);
} ff_table_reader;

/* `read`, on a host that has it; on others the model fails. */
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

/* `fail` with a printf format. */
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
