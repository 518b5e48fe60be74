/* SPDX-License-Identifier: MIT */
#include "tables.h"

#include "memory.h"

#include <stdlib.h>
#include <string.h>

struct fe_kept_table {
    const ff_table *table; /* NULL: it could not be read */
    char *item;
    struct fe_kept_table *next;
};

static void free_table(struct fe_kept_table *kept)
{
    ff_columns_free(kept->table);
    fe_free(kept->item);
    fe_free(kept);
}

ff_status fe_tables_read(fe_tables *tables, const char *item, const char *path,
                         const ff_param *rows, size_t count, size_t stride, const ff_table **table)
{
    struct fe_kept_table *kept = fe_alloc(sizeof *kept);
    fe_tables_forget(tables);
    ff_report *report = ff_report_new();
    if (path)
        kept->table = ff_columns_read(path, rows, count, stride, report);
    else
        ff_error(report, FF_FAULT_PLUGIN, FF_NOWHERE, NULL, "it gave no path");
    item = item ? item : "";
    kept->item = fe_copy_text(item, strlen(item));
    kept->next = tables->kept;
    tables->kept = kept; /* also one that failed: the error names its item */
    tables->item = kept->item;
    *table = kept->table;
    if (kept->table) {
        ff_report_free(report);
        return FF_OK;
    }
    tables->errors = report;
    return ff_report_fault(report) == FF_FAULT_PLUGIN ? FF_BUG : FF_INVALID;
}

ff_status fe_tables_fail(fe_tables *tables, const ff_table *table, size_t row, size_t column,
                         const char *text)
{
    fe_tables_forget(tables);
    struct fe_kept_table *kept = tables->kept;
    while (kept && kept->table != table)
        kept = kept->next;
    if (!table || !kept)
        return FF_BUG;
    tables->item = kept->item;
    tables->errors = ff_report_new();
    ff_error(tables->errors, FF_FAULT_INPUT, ff_columns_place(table, row, column), NULL, "%s",
             text);
    return FF_INVALID;
}

void fe_tables_print(const fe_tables *tables, char *out, size_t size)
{
    ff_message_print(ff_report_at(tables->errors, 0), out, size);
}

void fe_tables_forget(fe_tables *tables)
{
    ff_report_free(tables->errors);
    tables->errors = NULL;
}

void fe_tables_free(fe_tables *tables)
{
    fe_tables_forget(tables);
    for (struct fe_kept_table *kept = tables->kept, *next; kept; kept = next) {
        next = kept->next;
        free_table(kept);
    }
    *tables = (fe_tables){.kept = NULL};
}
