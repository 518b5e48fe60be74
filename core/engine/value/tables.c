/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tables.h"

#include "columns.h"
#include "memory.h"

#include <stdlib.h>
#include <string.h>

struct fe_kept_table {
    fe_columns columns;
    char *item;
    struct fe_kept_table *next;
};

static void free_table(struct fe_kept_table *kept)
{
    fe_columns_free(&kept->columns);
    fe_free(kept->item);
    fe_free(kept);
}

ff_status fe_tables_read(fe_tables *tables, const char *item, const char *path,
                         const ff_param *rows, size_t count, size_t stride, const ff_table **table)
{
    struct fe_kept_table *kept = fe_alloc(sizeof *kept);
    fe_tables_forget(tables);
    fe_report *report = fe_report_new();
    bool good = fe_columns_read(&kept->columns, path, rows, count, stride, report);
    kept->item = fe_copy_text(item, strlen(item));
    kept->next = tables->kept;
    tables->kept = kept; /* also one that failed: the error names its item */
    tables->item = kept->item;
    *table = good ? &kept->columns.table : NULL;
    if (good) {
        fe_report_free(report);
        return FF_OK;
    }
    tables->errors = report;
    return fe_report_exit_code(report) == FE_EXIT_PLUGIN ? FF_BUG : FF_INVALID;
}

ff_status fe_tables_fail(fe_tables *tables, const ff_table *table, size_t row, size_t column,
                         const char *text)
{
    fe_tables_forget(tables);
    struct fe_kept_table *kept = tables->kept;
    while (kept && &kept->columns.table != table)
        kept = kept->next;
    if (!kept)
        return FF_BUG;
    tables->item = kept->item;
    tables->errors = fe_report_new();
    fe_error(tables->errors, FE_EXIT_INPUT, fe_columns_place(&kept->columns, row, column), NULL,
             "%s", text);
    return FF_INVALID;
}

void fe_tables_print(const fe_tables *tables, char *out, size_t size)
{
    fe_message_print(fe_report_at(tables->errors, 0), out, size);
}

void fe_tables_forget(fe_tables *tables)
{
    fe_report_free(tables->errors);
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
