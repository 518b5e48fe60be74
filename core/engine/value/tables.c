/* SPDX-License-Identifier: MIT */
/* Reads tables for a model, and caches each one as long as its file is unchanged. */
#include "tables.h"

#include "memory.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

struct fe_kept_table {
    const ff_table *table; /* NULL: it could not be read */
    char *item;
    char *request; /* the requested column rows, packed */
    size_t request_size;
    struct stat file; /* file state before reading; st_nlink 0: a later change might not be
                         detected */
    struct fe_kept_table *next;
};

static void append(char *out, size_t *at, const void *bytes, size_t size)
{
    if (out)
        memcpy(out + *at, bytes, size);
    *at += size;
}

/* Packs the requested rows into bytes, since a model may have built the rows for this call only.
   Returns the size in bytes; `out` may be NULL. */
static size_t pack_rows(const ff_param *rows, size_t count, size_t stride, char *out)
{
    size_t at = 0;
    for (size_t k = 0; k < count; k++) {
        const ff_param *row = (const ff_param *)(const void *)((const char *)rows + k * stride);
        const char *group = row->group ? row->group : "\1";
        append(out, &at, row->name, strlen(row->name) + 1);
        append(out, &at, row->unit, strlen(row->unit) + 1);
        append(out, &at, group, strlen(group) + 1);
        append(out, &at, &row->flags, sizeof row->flags);
        append(out, &at, &row->min, sizeof row->min);
        append(out, &at, &row->max, sizeof row->max);
        append(out, &at, &row->min_count, sizeof row->min_count);
        append(out, &at, &row->max_count, sizeof row->max_count);
    }
    return at;
}

static void free_list(struct fe_kept_table **list)
{
    for (struct fe_kept_table *kept = *list, *next; kept; kept = next) {
        next = kept->next;
        ff_columns_free(kept->table);
        fe_free(kept->item);
        fe_free(kept->request);
        fe_free(kept);
    }
    *list = NULL;
}

/* Returns the state of a file before it is read. If the file was written within the last seconds,
   another write may leave the same time stamp, so that its state is marked as unsafe. */
static struct stat state_of(const char *path)
{
    enum { MOMENT = 2 }; /* in s */
    struct stat file;
    if (!path || stat(path, &file) != 0 || time(NULL) - file.st_mtim.tv_sec < MOMENT)
        return (struct stat){.st_nlink = 0};
    return file;
}

static bool same_file(const struct stat *a, const struct stat *b)
{
    return a->st_nlink > 0 && b->st_nlink > 0 && a->st_dev == b->st_dev && a->st_ino == b->st_ino &&
           a->st_size == b->st_size && a->st_mtim.tv_sec == b->st_mtim.tv_sec &&
           a->st_mtim.tv_nsec == b->st_mtim.tv_nsec && a->st_ctim.tv_sec == b->st_ctim.tv_sec &&
           a->st_ctim.tv_nsec == b->st_ctim.tv_nsec;
}

/* Whether both request the same columns of the same, unchanged file. */
static bool is_same(const struct fe_kept_table *a, const struct fe_kept_table *b, const char *path)
{
    return a->table && same_file(&a->file, &b->file) && a->request_size == b->request_size &&
           !memcmp(a->request, b->request, a->request_size) &&
           !strcmp(ff_columns_place(a->table, SIZE_MAX, SIZE_MAX).source->name, path);
}

/* Takes the table from the previous instance if that instance has read the same table, otherwise
   reads the table. */
static void find_table(fe_tables *tables, struct fe_kept_table *kept, const char *path,
                       const ff_param *rows, size_t count, size_t stride, ff_report *report)
{
    kept->request_size = pack_rows(rows, count, stride, NULL);
    kept->request = fe_alloc(kept->request_size + 1);
    pack_rows(rows, count, stride, kept->request);
    kept->file = state_of(path);
    for (struct fe_kept_table *spare = tables->spare; spare; spare = spare->next)
        if (is_same(spare, kept, path)) {
            kept->table = spare->table;
            spare->table = NULL;
            return;
        }
    kept->table = ff_columns_read(path, rows, count, stride, report);
}

ff_status fe_tables_read(fe_tables *tables, const char *item, const char *path,
                         const ff_param *rows, size_t count, size_t stride, const ff_table **table)
{
    struct fe_kept_table *kept = fe_alloc(sizeof *kept);
    fe_tables_forget(tables);
    ff_report *report = ff_report_new();
    if (path)
        find_table(tables, kept, path, rows, count, stride, report);
    else
        ff_error(report, FF_FAULT_PLUGIN, FF_NOWHERE, NULL, "it gave no path");
    item = item ? item : "";
    kept->item = fe_copy_text(item, strlen(item));
    kept->next = tables->kept;
    tables->kept = kept; /* also after a failure, since the error names its item */
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

void fe_tables_release(fe_tables *tables)
{
    fe_tables_forget(tables);
    free_list(&tables->spare);
    tables->spare = tables->kept;
    tables->kept = NULL;
    tables->item = NULL;
}

void fe_tables_free(fe_tables *tables)
{
    fe_tables_forget(tables);
    free_list(&tables->kept);
    free_list(&tables->spare);
    tables->item = NULL;
}
