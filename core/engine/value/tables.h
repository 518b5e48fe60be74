/* SPDX-License-Identifier: MIT */
/* Caches the tables that an instance of a model has read. */
#ifndef FE_TABLES_H
#define FE_TABLES_H

#include <flankfilm/engine.h>

/* The tables that one instance of a model reads through flankfilm.table/1. Must start zeroed. */
typedef struct fe_tables {
    struct fe_kept_table *kept;
    /* tables of the previous instance that were not yet requested again */
    struct fe_kept_table *spare;
    ff_report *errors; /* why the last call failed; NULL: it succeeded */
    const char *item;  /* item of the last call */
} fe_tables;

ff_status fe_tables_read(fe_tables *tables, const char *item, const char *path,
                         const ff_param *rows, size_t count, size_t stride, const ff_table **table);
/* Reports an error in a cell of a table. FF_BUG if the table was not read here. */
ff_status fe_tables_fail(fe_tables *tables, const ff_table *table, size_t row, size_t column,
                         const char *text);
/* Prints the first error: "load.csv:3:7: time must not decrease". */
void fe_tables_print(const fe_tables *tables, char *out, size_t size);
/* Marks the tables as unused. If one of them is requested later and its file is unchanged, it is
   not read again. */
void fe_tables_release(fe_tables *tables);
void fe_tables_free(fe_tables *tables);   /* frees all memory; `tables` may be used again */
void fe_tables_forget(fe_tables *tables); /* drops the errors */

#endif
