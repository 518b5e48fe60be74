/* SPDX-License-Identifier: MIT */
#ifndef FE_TABLES_H
#define FE_TABLES_H

#include <flankfilm/engine.h>

/* The tables that one instance of a model reads through flankfilm.table/1. Starts zeroed. */
typedef struct fe_tables {
    struct fe_kept_table *kept;
    struct fe_kept_table *spare; /* of the instance before, until they are asked for again */
    ff_report *errors;           /* why the last call failed; NULL: it did not */
    const char *item;            /* the item that the last call was about */
} fe_tables;

ff_status fe_tables_read(fe_tables *tables, const char *item, const char *path,
                         const ff_param *rows, size_t count, size_t stride, const ff_table **table);
/* FF_BUG for a table that was not read here. */
ff_status fe_tables_fail(fe_tables *tables, const ff_table *table, size_t row, size_t column,
                         const char *text);
/* "load.csv:3:7: time must not decrease", of the first error. */
void fe_tables_print(const fe_tables *tables, char *out, size_t size);
/* Nobody uses the tables any more; whoever asks for one again, and its file is as it was, gets it
   without reading the file. */
void fe_tables_release(fe_tables *tables);
void fe_tables_free(fe_tables *tables);   /* all of it; may be used again */
void fe_tables_forget(fe_tables *tables); /* the errors */

#endif
