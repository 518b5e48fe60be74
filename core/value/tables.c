/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tables.h"

#include "columns.h"
#include "memory.h"

#include <stdlib.h>
#include <string.h>

struct ff_kept_table {
    ff_columns columns;
    char *item;
    struct ff_kept_table *next;
};

static void free_table(struct ff_kept_table *kept)
{
    ff_columns_free(&kept->columns);
    free(kept->item);
    free(kept);
}

ff_status ff_tables_read(ff_tables *tables, const char *item, const char *path,
                         const ff_param *rows, size_t count, size_t stride, const ff_table **table)
{
    struct ff_kept_table *kept = ff_alloc(sizeof *kept);
    ff_tables_forget(tables);
    ff_report *report = ff_report_new();
    bool good = ff_columns_read(&kept->columns, path, rows, count, stride, report);
    kept->item = ff_copy_text(item, strlen(item));
    kept->next = tables->kept;
    tables->kept = kept; /* one that failed, too: its item is spoken of */
    tables->item = kept->item;
    *table = good ? &kept->columns.table : NULL;
    if (good) {
        ff_report_free(report);
        return FF_OK;
    }
    tables->said = report;
    return ff_report_exit_code(report) == FF_EXIT_PLUGIN ? FF_BUG : FF_INVALID;
}

ff_status ff_tables_fail(ff_tables *tables, const ff_table *table, size_t row, size_t column,
                         const char *text)
{
    ff_tables_forget(tables);
    struct ff_kept_table *kept = tables->kept;
    while (kept && &kept->columns.table != table)
        kept = kept->next;
    if (!kept)
        return FF_BUG;
    tables->item = kept->item;
    tables->said = ff_report_new();
    ff_error(tables->said, FF_EXIT_INPUT, ff_columns_place(&kept->columns, row, column), NULL, "%s",
             text);
    return FF_INVALID;
}

void ff_tables_print(const ff_tables *tables, char *out, size_t size)
{
    ff_message_print(ff_report_at(tables->said, 0), out, size);
}

void ff_tables_forget(ff_tables *tables)
{
    ff_report_free(tables->said);
    tables->said = NULL;
}

void ff_tables_free(ff_tables *tables)
{
    ff_tables_forget(tables);
    for (struct ff_kept_table *kept = tables->kept, *next; kept; kept = next) {
        next = kept->next;
        free_table(kept);
    }
    *tables = (ff_tables){.kept = NULL};
}
